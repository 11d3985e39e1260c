"""Faulty decks and their messages, to the letter. Each fault changes base.k (or two_blocks.k,
space.k) in one place; the expected text is in expected.txt. `faults.py --write` makes that file anew
(read the difference!). Every fault must give exit code 2 and write no file."""

import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
BASES = {name: open(os.path.join(HERE, name + ".k")).read() for name in ("base", "two_blocks", "space")}

# Faults of base.k: name, text that is there, text that takes its place (more pairs may follow).
NODE = "       2             1.0             0.0"
ELEMENT = "       1       1       1       2       3       4"
MATERIAL = "         1     0.001    1000.0       0.3"
CURVE = "*DEFINE_CURVE\n1,\n0.0,1.0\n0.1,1.0\n"
EXPRESSION = "*PARAMETER_EXPRESSION\n"
FINITE = "*CONTROL_IMPLICIT_SOLUTION\n        12\n"
EXPLICIT = "PAOLI,,,,,,0.0"
PARAMETER = "Rtend           0.01Rdt            1e-03"
RIGID = ("*MAT_ELASTIC\n" + MATERIAL, "*MAT_RIGID\n         1     0.001\n\n")
HELD = ("*MAT_ELASTIC\n" + MATERIAL, "*MAT_RIGID\n         1     0.001\n       1.0         1\n")


def law(name, fields, more="", title=""):
    """The material of base.k and another one in its place."""
    return "*MAT_ELASTIC\n" + MATERIAL, "*MAT_" + name + "\n" + title + MATERIAL[:20] + fields + more


MOTION = "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,1,0,1\n"
SECTION = "         1        13                   4"
RING = (SECTION, SECTION.replace("13", "15"))
BASE_FAULTS = [
    # around an axis
    ("a node left of the axis", *RING, "       4             0.0", "       4            -0.5"),
    ("a plane part beside a ring", *RING, "*SET_NODE_LIST", "*PART\nplane\n2,2,1\n"
     "*SECTION_SHELL\n2,13\n1.0\n*NODE\n5,3.0,0.0\n6,4.0,0.0\n7,4.0,1.0\n*ELEMENT_SHELL\n"
     "2,2,5,6,7,7\n*SET_NODE_LIST"),
    ("a rigid ring", *RING, *RIGID),
    ("waves of bars around an axis", *RING, "*NODE", "*BIPACT_MASS\nDISPERSION,0\n*NODE"),
    ("a ring that rotates", *RING, "*END", "*INITIAL_VELOCITY_GENERATION\n1,2,1.0\n0.0\n*END"),
    ("a body load across the axis", *RING, "*END", CURVE + "*LOAD_BODY_X\n1,1.0\n*END"),
    ("a free wall that leaves the axis", *RING, "*END",
     "*RIGIDWALL_PLANAR_MOVING\n0,\n3.0,0.0,0.0,2.0,0.5\n1.0,1.0\n*END"),
    ("a driven node on the axis", *RING, "*END",
     CURVE + "*BOUNDARY_PRESCRIBED_MOTION_NODE\n1,1,2,1\n*END"),
    # the frame
    ("unknown keyword", "*DATABASE_GLSTAT", "*DATABASE_GLSTATS"),
    ("unknown option", "*CONTROL_TERMINATION", "*CONTROL_TERMINATION_FOO"),
    ("nonsense keyword", "*END", "*XYZZY_PLUGH\n*END"),
    ("keyword of a refused family misspelt", "*SET_NODE_LIST", "*SET_NODE_LSIT"),
    ("refused keyword", "*END", "*MAT_JOHNSON_COOK\n*END"),
    ("refused option of a law", "*END", "*MAT_024_LOG_INTERPOLATION\n*END"),
    ("refused family", "*END", "*CONSTRAINED_JOINT_REVOLUTE\n*END"),
    ("three-dimensional contact", "*END", "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,1,3,3\n*END"),
    ("a solid in a plane deck", "*END", "*ELEMENT_SOLID\n2,1,1,2,3,4,1,2,3,4\n*END"),
    ("a section of solids for shells", "*SECTION_SHELL\n         1        13                   4\n       1.0",
     "*SECTION_SOLID\n         1         2"),
    ("a body load along z in the plane", "*END", CURVE + "*LOAD_BODY_Z\n1,1.0\n*END"),
    ("a velocity along z in the plane", "*INITIAL_VELOCITY\n         1\n       1.0",
     "*INITIAL_VELOCITY\n         1\n       1.0       0.0       2.0"),
    ("option of another keyword", "*INITIAL_VELOCITY\n", "*INITIAL_VELOCITY_TITLE\n"),
    ("ids of ten columns", "*KEYWORD", "*KEYWORD I10=Y"),
    ("stray card", "*KEYWORD\n", "*KEYWORD\n         1\n"),
    ("keyword missing", "*CONTROL_IMPLICIT_DYNAMICS\n         1\n", ""),
    ("end time missing", "*CONTROL_TERMINATION\n     &tend\n", ""),
    ("keyword twice", "*END", "*DATABASE_GLSTAT\n     0.002\n*END"),
    ("own keyword twice", "*END", "*BIPACT_TIME\n     THETA\n*END"),
    (
        "card missing",
        "*INITIAL_VELOCITY\n         1\n       1.0\n",
        "*INITIAL_VELOCITY\n         1\n",
    ),
    ("all cards missing", "*MAT_ELASTIC\n" + MATERIAL + "\n", "*MAT_ELASTIC\n"),
    ("half a part", "*SECTION_SHELL", "another\n*SECTION_SHELL"),
    ("card too many", "*TITLE\n", "*TITLE\none\ntwo\n"),
    (
        "title too long",
        "a block in flight, the deck that the faulty ones are made from",
        "a title of more than eighty columns, which would be cut if it were taken; nothing is ever cut",
    ),
    ("an include that is not there", "*END", "*INCLUDE\nnowhere.k\n*END"),
    ("an include without a name", "*END", "*INCLUDE\n*END"),
    ("an include of itself", "*END", "*INCLUDE\ndeck.k\n*END"),
    # names that are nearly right, and names of files
    ("output that nobody has", "*END", "*DATABASE_ABSTATS\n     0.001\n*END"),
    ("control that nobody has", "*END", "*CONTROL_ACCURACCY\n         0\n*END"),
    ("an include in no folder", "*END", "*INCLUDE_PATH\nnowhere\n*INCLUDE\nmesh.k\n*END"),
    # expressions
    ("division by zero", "*END", EXPRESSION + "R a       1.0/(2-2)\n*END"),
    ("not finite", "*END", EXPRESSION + "R a       exp(1000.)\n*END"),
    ("a power too large", "*END", EXPRESSION + "R a       10.0**400\n*END"),
    ("an integer too large", "*END", EXPRESSION + "I n       50000*50000\n*END"),
    ("unknown name", "*END", EXPRESSION + "R a       2*dtt\n*END"),
    ("unknown function", "*END", EXPRESSION + "R a       sinus(1.0)\n*END"),
    ("too few arguments", "*END", EXPRESSION + "R a       atan2(1.0)\n*END"),
    ("parenthesis left open", "*END", EXPRESSION + "R a       2*(1+dt\n*END"),
    ("parenthesis too many", "*END", EXPRESSION + "R a       2*(1+dt))\n*END"),
    ("nothing after an operator", "*END", EXPRESSION + "R a       2*dt+\n*END"),
    ("two values without operator", "*END", EXPRESSION + "R a       2 dt\n*END"),
    ("a number of two points", "*END", EXPRESSION + "R a       1.2.3\n*END"),
    ("root of a negative number", "*END", EXPRESSION + "R a       sqrt(-2.0)\n*END"),
    ("logarithm of zero", "*END", EXPRESSION + "R a       log(0.0)\n*END"),
    ("negative number to a broken power", "*END", EXPRESSION + "R a       (-2.0)**0.5\n*END"),
    ("a fraction for an integer parameter", "*END", EXPRESSION + "I n       7.5\n*END"),
    ("an expression for a word", "*END", EXPRESSION + "C n       7.5\n*END"),
    ("an expression twice", "*END", EXPRESSION + "R dt      7.5\n*END"),
    ("an expression without a name", "*END", EXPRESSION + "          7.5\n*END"),
    ("fault on the second line", "*END", EXPRESSION + "R a       1.0 +\n          2.0 * b\n*END"),
    ("fault in comma form", "*END", EXPRESSION + "R a,1.0+b\n*END"),
    ("a local parameter twice", "*END", "*PARAMETER_LOCAL\nRa               1.0Ra               2.0\n*END"),
    # parameters
    ("undefined parameter", "     &tend", "     &tond"),
    ("undefined parameter with a sign", "     &tend", "    -&tond"),
    (
        "parameter used before",
        "*PARAMETER\n" + PARAMETER + "\n*CONTROL_TERMINATION\n     &tend",
        "*CONTROL_TERMINATION\n     &tend",
    ),
    ("parameter one column short", PARAMETER, "Rtend          0.01Rdt            1e-03"),
    ("parameter twice", "Rdt            1e-03", "Rtend          1e-03"),
    ("parameter without type", PARAMETER, "tend            0.01Rdt            1e-03"),
    ("parameter of no name", PARAMETER, PARAMETER + "R                1.0"),
    ("parameter without value", "Rdt            1e-03", "Rdt                 "),
    ("integer parameter of a real", PARAMETER, PARAMETER + "Iset             1.5"),
    ("a fifth parameter", PARAMETER, PARAMETER + "Ra               1.0Rb               1.0R"),
    (
        "word parameter with a sign",
        PARAMETER,
        PARAMETER + "Cscheme        THETA",
        "     THETA       0.5",
        "  -&scheme       0.5",
    ),
    ("tab in a parameter card", PARAMETER, "Rtend\t0.01"),
    # numbers and columns
    ("letter in a number", NODE, "       2             1.O             0.0"),
    ("blank in a number", NODE, "       2             1 0             0.0"),
    ("nan", NODE, "       2             nan             0.0"),
    ("infinity", NODE, "       2             inf             0.0"),
    ("two points", NODE, "       2           1.0.0             0.0"),
    ("two signs", NODE, "       2            --1.             0.0"),
    ("exponent without digits", NODE, "       2            1.0e             0.0"),
    ("only a sign", NODE, "       2               -             0.0"),
    ("division", NODE, "       2             1/2             0.0"),
    ("repeat count", NODE, "       2           3*1.0             0.0"),
    ("overflow", NODE, "       2         1.0e999             0.0"),
    ("fraction for an integer", ELEMENT, "       1       1     1.5       2       3       4"),
    ("integer too large", ELEMENT, "99999999999999999,1,1,2,3,4"),
    ("negative number of a node", NODE, "      -2             1.0             0.0"),
    ("tab", "     0.001\n*END", "\t0.001\n*END"),
    ("accent in a data card", "     0.001\n*END", "    0,001\u00e9\n*END"),
    ("card shifted right", NODE, "       2               1.0             0.0"),
    ("a value across a border", ELEMENT, "       1       1       1     2345      3       4"),
    ("too many commas", "     0.001\n*END", "0.001,0,0,0,5,6,7,8,9\n*END"),
    ("beyond the last field", MATERIAL, MATERIAL + " " * 30 + "7"),
    ("comma in a column card", NODE, "       2,            1.0             0.0"),
    # ranges and classes
    ("out of range", MATERIAL, "         1     0.001    1000.0       0.5"),
    ("negative density", MATERIAL, "         1    -0.001    1000.0       0.3"),
    ("no density", MATERIAL, "         1       0.0    1000.0       0.3"),
    ("missing value", MATERIAL, "         1              1000.0       0.3"),
    ("negative step", "Rdt            1e-03", "Rdt           -1e-03"),
    ("no end time", "Rtend           0.01", "Rtend            0.0"),
    ("steps without end", "Rdt            1e-03", "Rdt           1e-300"),
    (
        "field not available",
        "*INITIAL_VELOCITY\n         1",
        "*INITIAL_VELOCITY\n         1         3",
    ),
    (
        "velocity across the plane",
        "       1.0\n*DATABASE",
        "       1.0       0.0       2.0\n*DATABASE",
    ),
    ("unknown constraint on the node card", NODE, NODE + "             0.0       9"),
    ("explicit", "         1       &dt", "         0       &dt"),
    (
        "static",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1",
        "*CONTROL_IMPLICIT_DYNAMICS\n         0",
    ),
    (
        "HHT",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1",
        "*CONTROL_IMPLICIT_DYNAMICS\n"
        + "         1       0.5      0.25"
        + " " * 40
        + "      -0.1",
    ),
    (
        "unstable beta",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1       0.5       0.1",
    ),
    ("a nonlinear solver that is not there", "*END", "*CONTROL_IMPLICIT_SOLUTION\n         6\n*END"),
    ("kinematics of a linear deck", "*END", "*BIPACT_KINEMATICS\nEMC\n*END"),
    ("a force of a step that is not there", "*END", FINITE + "*BIPACT_KINEMATICS\nENDS\n*END"),
    ("another elastic law", "*END", FINITE + "*BIPACT_KINEMATICS\n,OGDEN\n*END"),
    ("mean dilatation neither on nor off", "*END", FINITE + "*BIPACT_KINEMATICS\n,,2\n*END"),
    ("a force of another scheme", "*END", FINITE + "*BIPACT_KINEMATICS\nEMC\n*END",
     "     THETA       0.5", "   NEWMARK"),
    ("a force of the middle and an xi", "*END", FINITE + "*END",
     "     THETA       0.5", "     THETA       0.5       0.7"),
    ("passes of a factor, below none", "*END",
     "*CONTROL_IMPLICIT_SOLUTION\n12,-1,,-1.0\n*END"),
    ("a scheme without finite deformation", "*END", FINITE + "*END", "     THETA       0.5", "    MOREAU"),
    ("implicit Paoli at finite deformation", "*END", FINITE + "*END", "     THETA       0.5", "     PAOLI"),
    ("dispersion at finite deformation", "*END", FINITE + "*BIPACT_MASS\nDISPERSION,\n*END"),
    ("damping by stiffness at finite deformation", "*END",
     FINITE + "*DAMPING_PART_STIFFNESS\n1,-1e-5\n*END"),
    ("damping of a set by stiffness at finite deformation", "*END",
     FINITE + "*SET_PART_LIST\n1,\n1,\n*DAMPING_PART_STIFFNESS_SET\n1,-1e-5\n*END"),
    ("automatic steps of another kind", "*END", "*CONTROL_IMPLICIT_AUTO\n         2\n*END"),
    ("longest step", "*END", "*CONTROL_IMPLICIT_AUTO\n1,,,,0.01\n*END"),
    ("automatic steps and own steps", "*END", "*CONTROL_IMPLICIT_AUTO\n1,\n*BIPACT_STEP\n,\n*END"),
    (
        "automatic steps of a two-step scheme",
        "*END",
        "*CONTROL_IMPLICIT_AUTO\n1,\n*END",
        "     THETA       0.5",
        "     PAOLI",
    ),
    (
        "cut steps in statics",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1\n*BIPACT_TIME\n     THETA       0.5",
        "*CONTROL_IMPLICIT_DYNAMICS\n         0\n*BIPACT_STEP\n     EVENT",
    ),
    ("steps", "*END", "*BIPACT_STEP\n     ADAPT\n*END"),
    ("shortest step of fixed ones", "*END", "*BIPACT_STEP\n     FIXED    1.0E-5\n*END"),
    ("halvings of steps that are cut", "*END", "*BIPACT_STEP\nEVENT,,,,4\n*END"),
    ("shortest step beyond DT0", "*END", "*BIPACT_STEP\n     HALVE       0.1\n*END"),
    ("too many halvings", "*END", "*BIPACT_STEP\nHALVE,,,,21\n*END"),
    ("longest step of halved ones", "*END", "*BIPACT_STEP\nHALVE,,0.001\n*END"),
    (
        "halved steps of a two-step scheme",
        "*END",
        "*BIPACT_STEP\n     HALVE\n*END",
        "     THETA       0.5",
        "     PAOLI",
    ),
    (
        "cut steps of a two-step scheme",
        "*END",
        "*BIPACT_STEP\n     EVENT\n*END",
        "     THETA       0.5",
        "     PAOLI",
    ),
    (
        "mass scaling",
        "*END",
        "*CONTROL_TIMESTEP\n       0.0       0.9         0       0.0   -1.0e-6\n*END",
    ),
    # damping
    ("damping by a fraction", "*END", "*DAMPING_PART_STIFFNESS\n         1       0.1\n*END"),
    ("damping of no part", "*END", "*DAMPING_PART_STIFFNESS\n         7      -0.1\n*END"),
    ("damping of no part set", "*END", "*DAMPING_PART_STIFFNESS_SET\n         7      -0.1\n*END"),
    ("damping by no curve", "*END", "*DAMPING_PART_MASS\n         1         7\n*END"),
    ("damping with scales", "*END", CURVE + "*DAMPING_PART_MASS\n1,1,1.0,1\n*END"),
    ("damping below zero", "*END", "*DAMPING_GLOBAL\n         0      -1.0\n*END"),
    (
        "damping by a curve below zero",
        "*END",
        CURVE.replace("0.1,1.0", "0.1,-1.0") + "*DAMPING_GLOBAL\n         1\n*END",
    ),
    (
        "damping of a part and of all",
        "*END",
        CURVE + "*DAMPING_GLOBAL\n         1\n*DAMPING_PART_MASS\n         1         1\n*END",
    ),
    (
        "damping of a part twice",
        "*END",
        "*DAMPING_PART_STIFFNESS\n         1      -0.1\n         1      -0.2\n*END",
    ),
    ("friction of all contacts", "*END", "*CONTROL_CONTACT\n\n\n       0.3\n*END"),
    ("scheme", "     THETA       0.5", "      TETA       0.5"),
    ("scheme to come", "     THETA       0.5", "     LLOVE"),
    ("theta of newmark", "     THETA       0.5", "   NEWMARK       0.5"),
    ("theta out of range", "     THETA       0.5", "     THETA       0.4"),
    (
        "restitution of theta",
        "     THETA       0.5",
        "     THETA       0.5       0.5       0.8",
    ),
    ("restitution of a pair", "*END", "*BIPACT_PAIR\n         1,,,,0.5\n*END"),
    ("damping of nsgenalpha", "     THETA       0.5", "NSGENALPHA", "*END", "*DAMPING_PART_MASS\n1,1,2.0\n*DEFINE_CURVE\n1,\n0.0,1.0\n9.0,1.0\n*END"),
    ("rule of paoli", "     THETA       0.5", "     PAOLI,,,,,PLAIN"),
    ("restitution out of range", "     THETA       0.5", "    MOREAU,,,1.5"),
    (
        "singular mass",
        "     THETA       0.5",
        "   THETAPV",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nDISPERSION\n*BIPACT_TIME",
    ),
    (
        "massless nodes without damping",
        "     THETA       0.5",
        "    MOREAU",
        "*BIPACT_TIME",
        "*BIPACT_MASS\n    LUMPED         1\n*BIPACT_TIME",
    ),
    ("mass", "*BIPACT_TIME", "*BIPACT_MASS\n    LUMPEN\n*BIPACT_TIME"),
    (
        "courant of a lumped mass",
        "*BIPACT_TIME",
        "*BIPACT_MASS\n    LUMPED         0       1.0\n*BIPACT_TIME",
    ),
    (
        "waves of a lumped mass",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nLUMPED,,,S\n*BIPACT_TIME",
    ),
    (
        "direction of pressure waves",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nDISPERSION,,,P,1.0\n*BIPACT_TIME",
    ),
    (
        "shear waves without direction",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nDISPERSION,,,S\n*BIPACT_TIME",
    ),
    (
        "shear waves in the plane",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nDISPERSION,,,S,,,1.0\n*BIPACT_TIME",
    ),
    (
        "dispersion and cut step",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nDISPERSION\n*BIPACT_TIME",
        "     &tend",
        "    0.0105",
    ),
    ("contact solver", "*END", "*BIPACT_CONTACT\n    LEMKE\n*END"),
    ("tolerance", "*END", "*BIPACT_CONTACT\n      AUTO       0.5\n*END"),
    ("local solver", "*END", "*BIPACT_CONTACT\n        GS,,,,LEMKE\n*END"),
    ("field name", "*END", "*BIPACT_FIELD\n     0.001\n         U    STRAIN\n*END"),
    ("field bits", "*END", "*BIPACT_FIELD\n     0.001                            48\n*END"),
    ("field times", "*END", "*BIPACT_FIELD\n     0.001,,,,0.2,0.1\n*END"),
    ("field part set", "*END", "*BIPACT_FIELD\n     0.001        99\n*END"),
    ("restart keep", "*END", "*BIPACT_RESTART\n       100,,0\n*END"),
    ("d3plot curve", "*END", "*DATABASE_BINARY_D3PLOT\n     0.001         5\n*END"),
    ("engine", "*END", "*BIPACT_SOLVER\n   PARDISO\n*END"),
    ("engine of several ranks", "*END", "*BIPACT_SOLVER\n     MUMPS\n*END"),
    # explicit runs
    ("implicit flag", "         1       &dt", "         4       &dt"),
    ("no step", "         1       &dt", "         1"),
    ("no step card", "*CONTROL_IMPLICIT_GENERAL\n         1       &dt\n", ""),
    (
        "explicit and static",
        "         1       &dt",
        "         0       &dt",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1",
        "*CONTROL_IMPLICIT_DYNAMICS\n         0",
        "*BIPACT_TIME\n     THETA       0.5\n",
        "",
    ),
    ("beta of another scheme", "     THETA       0.5", "THETA,,,,,,0.25"),
    ("beta between", "     THETA       0.5", "PAOLI,,,,,,0.1"),
    ("diagonal engine of an implicit scheme", "*END", "*BIPACT_SOLVER\n  DIAGONAL\n*END"),
    ("explicit, above the limit", "     THETA       0.5", EXPLICIT),
    ("explicit, consistent", "     THETA       0.5", EXPLICIT + "\n*BIPACT_MASS\nCONSISTENT"),
    ("explicit, massless", "     THETA       0.5", EXPLICIT + "\n*BIPACT_MASS\nLUMPED,1"),
    ("explicit, another engine", "     THETA       0.5", EXPLICIT + "\n*BIPACT_SOLVER\nLDLT,"),
    ("explicit, an order", "     THETA       0.5", EXPLICIT + "\n*BIPACT_SOLVER\n,METIS"),
    ("explicit, TSSFAC", "     THETA       0.5", EXPLICIT + "\n*CONTROL_TIMESTEP\n,1.2"),
    ("explicit, LCTM", "     THETA       0.5", EXPLICIT + "\n*CONTROL_TIMESTEP\n,,,,,5"),
    (
        "explicit, static phase without a step",
        "     THETA       0.5",
        EXPLICIT,
        "         1       &dt",
        "         0",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1",
        "*CONTROL_IMPLICIT_DYNAMICS\n1,,,0.005",
    ),
    (
        "explicit, steps without end",
        "     THETA       0.5",
        EXPLICIT,
        "         1       &dt",
        "         0",
        "     &tend",
        "    1.0e9",
    ),
    # mesh
    ("undefined node", ELEMENT, "       1       1       1       2       3       9"),
    ("clockwise", ELEMENT, "       1       1       4       3       2       1"),
    ("crossed", ELEMENT, "       1       1       1       3       2       4"),
    ("degenerate", ELEMENT, "       1       1       1       2       2       4"),
    (
        "clockwise triangle",
        ELEMENT,
        "       1       1       1       4       3\n       2       1       1       2       3",
    ),
    (
        "triangle with the mass DISPERSION",
        ELEMENT,
        "       1       1       1       2       3\n       2       1       1       3       4",
        "*BIPACT_TIME",
        "*BIPACT_MASS\nDISPERSION\n*BIPACT_TIME",
    ),
    ("quadratic element", ELEMENT, ELEMENT + "       5"),
    (
        "node twice",
        "       4             0.0             1.0",
        "       3             0.0             1.0",
    ),
    ("element twice", ELEMENT, ELEMENT + "\n" + ELEMENT),
    (
        "node without element",
        "       4             0.0             1.0",
        "       4             0.0             1.0\n       5             7.0             1.0",
    ),
    (
        "node off the plane",
        "       4             0.0             1.0",
        "       4             0.0             1.0             0.5",
    ),
    ("no element", "*ELEMENT_SHELL\n" + ELEMENT + "\n", ""),
    ("undefined part", "       1       1       1       2", "       1       2       1       2"),
    (
        "part without element",
        "*SECTION_SHELL",
        "spare\n         2         1         1\n*SECTION_SHELL",
    ),
    ("part twice", "*SECTION_SHELL", "spare\n         1         1         1\n*SECTION_SHELL"),
    ("beam of a part", "*PART", "*ELEMENT_BEAM\n       7       1       1       2\n*PART"),
    (
        "equation of state of a part",
        "         1         1         1\n*SECTION",
        "         1         1         1         3\n*SECTION",
    ),
    (
        "undefined section",
        "         1         1         1\n*SECTION",
        "         1         4         1\n*SECTION",
    ),
    (
        "undefined material",
        "         1         1         1\n*SECTION",
        "         1         1         4\n*SECTION",
    ),
    (
        "material twice",
        "*MAT_ELASTIC\n" + MATERIAL,
        "*MAT_001\n" + MATERIAL + "\n*MAT_ELASTIC\n" + MATERIAL,
    ),
    (
        "element form",
        "         1        13                   4",
        "         1        16                   4",
    ),
    (
        "integration points",
        "         1        13                   4",
        "         1        13                   1",
    ),
    ("unequal thickness", "       1.0\n*MAT", "       1.0       2.0\n*MAT"),
    # sets, motions, loads
    ("undefined set", "*INITIAL_VELOCITY\n         1", "*INITIAL_VELOCITY\n         7"),
    (
        "undefined member",
        "         1         2         3         4",
        "         1         2         3        14",
    ),
    ("set twice", "*INITIAL_VELOCITY", "*SET_NODE\n         1\n         1\n*INITIAL_VELOCITY"),
    (
        "empty set",
        "         1         2         3         4\n*INIT",
        "         0         0         0         0\n*INIT",
    ),
    (
        "range backwards",
        "*END",
        "*SET_NODE_LIST_GENERATE\n         3\n         4         2\n*END",
    ),
    ("segment inside", "*END", "*SET_SEGMENT\n         3\n         1         3\n*END"),
    (
        "segment of three nodes",
        "*END",
        "*SET_SEGMENT\n         3\n         1         2         3         3\n*END",
    ),
    ("a set of another solver", "*END", "*SET_NODE_LIST\n         7       0.0       0.0       0.0       0.0CESE\n         1\n*END"),
    ("attributes of a set", "*END", "*SET_NODE_COLUMN\n         7\n         1       2.0\n*END"),
    ("a box backwards", "*END", "*DEFINE_BOX\n         1       1.0       0.0\n*END"),
    ("a clause of no box", "*END", "*SET_NODE_GENERAL\n         7\n       BOX         3\n*END"),
    ("a clause that is none", "*END", "*SET_NODE_GENERAL\n         7\n      TUBE         3\n*END"),
    ("an empty set of clauses", "*END", "*SET_NODE_GENERAL\n         7\n       ALL\n     DPART         1\n*END"),
    ("no edge", "*END", "*SET_SEGMENT_GENERAL\n         7\n       SEG         1         3\n*END"),
    ("a part without material", "         1         1         1\n*SECTION", "         1         1         0\n*SECTION"),
    ("a part without anything", "         1         1         1\n*SECTION", "         1\n*SECTION"),
    ("dynamic relaxation", "*END", "*DEFINE_CURVE\n         1         1\n                 0.0                 1.0\n*END"),
    ("an offset into the points", "*END", "*DEFINE_CURVE\n         1                                     0.5\n                -1.0                 1.0\n*END"),
    ("a history without a number", "*END", "*DATABASE_HISTORY_NODE_ID\n          corner\n*END"),
    ("a coupled analysis", "*END", "*CONTROL_SOLUTION\n         2\n*END"),
    ("a fluid", MATERIAL, MATERIAL + " " * 20 + "     100.0"),
    ("support of nobody", "*END", "*BOUNDARY_SPC_SET\n         9                   1\n*END"),
    ("two velocities", "*END", "*INITIAL_VELOCITY_NODE\n         1       2.0\n*END"),
    (
        "rotation about x",
        "*END",
        "*INITIAL_VELOCITY_GENERATION\n         1         2       5.0\n"
        "       0.0       0.0       0.0       0.0       0.0       2.0\n*END",
    ),
    (
        "velocity of a part that is not there",
        "*END",
        "*INITIAL_VELOCITY_GENERATION\n         7         2\n\n*END",
    ),
    ("curve missing", "*END", "*LOAD_BODY_Y\n         3       1.0\n*END"),
    (
        "curve not increasing",
        "*END",
        "*DEFINE_CURVE\n         3\n                 0.0                 1.0\n"
        "                 0.0                 1.0\n*END",
    ),
    ("curve without points", "*END", "*DEFINE_CURVE\n         3\n*END"),
    ("load in z", "*END", "*LOAD_BODY_Z\n         3       1.0\n*END"),
    ("follower force", "*END", "*LOAD_NODE_POINT\n         1         4         3\n*END"),
    (
        "acceleration for theta",
        "*END",
        "*DEFINE_CURVE\n         3\n                 0.0                 1.0\n"
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n         1         1         1         3\n*END",
    ),
    (
        "motion of a fixed direction",
        "*END",
        "*DEFINE_CURVE\n         3\n                 0.0                 1.0\n"
        "*BOUNDARY_SPC_NODE\n         1                             1\n"
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n         1         2         2         3\n*END",
    ),
    (
        "two motions",
        "*END",
        "*DEFINE_CURVE\n         3\n                 0.0                 1.0\n"
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n         1         2         2         3\n"
        "         1         2         2         3\n*END",
    ),
    (
        "motion that contradicts a velocity",
        "*END",
        "*DEFINE_CURVE\n         3\n                 0.0                 5.0\n"
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n         1         1         0         3\n*END",
    ),
    (
        "motion that dies before its birth",
        "*END",
        "*DEFINE_CURVE\n         3\n                 0.0                 1.0\n"
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n         1         2         2         3                        0.001     0.002\n*END",
    ),
    ("history of nobody", "*END", "*DATABASE_HISTORY_NODE\n        77\n*END"),
    ("history of no element", "*END", "*DATABASE_HISTORY_SHELL\n        77\n*END"),
    ("several at once", "     0.001    1000.0       0.3", "      zero   -1000.0       0.7"),
    # rigid parts
    ("support of rigid nodes", *RIGID, "*END", "*BOUNDARY_SPC_NODE\n1,,1\n*END"),
    ("force on a rigid node", *RIGID, "*END", CURVE + "*LOAD_NODE_POINT\n1,1,1\n*END"),
    (
        "motion of a rigid node",
        *RIGID,
        "*END",
        CURVE + "*BOUNDARY_PRESCRIBED_MOTION_NODE\n1,1,0,1\n*END",
    ),
    ("velocity of no rigid part", "*END", "*INITIAL_VELOCITY_RIGID_BODY\n1,1.0\n*END"),
    ("two velocities of a rigid part", *RIGID, "*END", "*INITIAL_VELOCITY_RIGID_BODY\n1,1.0\n1,2.0\n*END"),
    ("velocities that strain a rigid part", *RIGID, "         1         2         3         4", "         1         2"),
    ("force on no part", *RIGID, "*END", CURVE + "*LOAD_RIGID_BODY\n7,1,1\n*END"),
    ("force across the plane", *RIGID, "*END", CURVE + "*LOAD_RIGID_BODY\n1,3,1\n*END"),
    ("motion of a held rigid part", *HELD, "*END", CURVE + MOTION + "*END"),
    ("two motions of a rigid part", *RIGID, "*END", CURVE + MOTION + MOTION + "*END"),
    ("acceleration of a rigid part", *RIGID, "*END", CURVE + MOTION.replace(",0,", ",1,") + "*END"),
    ("inertia of a deformable part", "*PART\nblock\n         1         1         1", "*PART_INERTIA\nblock\n1,1,1\n0.5,0.5,,1.0\n,,,,,1.0\n"),
    ("inertia without a mass", *RIGID, "*PART\nblock\n         1         1         1", "*PART_INERTIA\nblock\n1,1,1\n0.5,0.5\n,,,,,1.0\n"),
    ("a rigid part joins itself", *RIGID, "*END", "*CONSTRAINED_RIGID_BODIES\n1,1\n*END"),
    (
        "a node of a rigid and a deformable part",
        ELEMENT,
        ELEMENT + "\n       2       2       2       5       6       3",
        "       4             0.0             1.0",
        "       4             0.0             1.0\n       5             2.0             0.0\n       6             2.0             1.0",
        "*SECTION_SHELL",
        "*PART\nrigid\n         2         1         2\n*MAT_RIGID\n         2     0.001\n\n\n*SECTION_SHELL",
    ),
    ("explicit step of rigid parts", *RIGID, "     THETA       0.5", "CDLAGRANGE", "         1       &dt", "         1"),
    ("local constraints", *RIGID, "*MAT_RIGID\n         1     0.001\n", "*MAT_RIGID\n         1     0.001\n      -1.0"),
    # laws at finite strain
    ("rubber in a linear deck", *law("BLATZ-KO_RUBBER", "    1000.0")),
    ("foam in a linear deck by its number", *law("038_TITLE", "    1000.0", title="foam\n")),
    ("a plastic law in a linear deck", *law("PLASTIC_KINEMATIC", "    1000.0       0.3      10.0",
                                            "\n       0.0       0.0    1.0E20")),
    ("a reference geometry", *law("007", "    1000.0       1.0")),
    ("rubber without a modulus", *law("BLATZ-KO_RUBBER", "")),
    ("Mooney and Rivlin with a Poisson ratio too small",
     *law("MOONEY-RIVLIN_RUBBER", "       0.4     400.0     100.0")),
    ("Mooney and Rivlin without stiffness", *law("027", "     0.495     100.0    -100.0")),
    ("a fit of Mooney and Rivlin", *law("027", "     0.495     100.0", "\n      50.0")),
    ("a term of Ogden without exponent", *law("OGDEN_RUBBER", "     0.495", "\n  1.0,2.0\n  2.0,")),
    ("Ogden without stiffness", *law("077_O", "     0.495         0         6",
                                     "\n       1.0\n      -2.0")),
    ("a fit of Ogden", *law("077_O", "     0.495         2", "\n       1.0\n       2.0")),
    ("a second invariant", *law("HYPERELASTIC_RUBBER", "     0.495", "\n      10.0       1.0")),
    ("a tangent modulus above E", *law("003", "    1000.0       0.3      10.0    1000.0")),
    ("hardening neither kinematic nor isotropic",
     *law("003", "    1000.0       0.3      10.0     100.0       1.5")),
    ("rates and failure", *law("PLASTIC_KINEMATIC", "    1000.0       0.3      10.0",
                               "\n      40.0       5.0      0.75       1.0")),
    ("rates and failure of a curve", *law("024", "    1000.0       0.3      10.0       0.0       0.5",
                                          "\n      40.0       5.0")),
    ("no yield stress", *law("PIECEWISE_LINEAR_PLASTICITY", "    1000.0       0.3")),
    ("a yield curve that is not there", *law("024", "    1000.0       0.3", "\n,,7,")),
    ("a yield curve that falls", "*END", CURVE.replace("0.1,1.0", "0.1,0.9") + "*END",
     *law("024", "    1000.0       0.3", "\n,,1,")),
    ("yield points that do not begin at 0",
     *law("024", "    1000.0       0.3", "\n\n0.01,0.1\n10.0,20.0")),
    ("yield points out of order",
     *law("024", "    1000.0       0.3", "\n\n0.0,0.1,0.05\n10.0,20.0,30.0")),
    ("yield stresses that fall", *law("024", "    1000.0       0.3", "\n\n0.0,0.1\n10.0,5.0")),
]

CONTACT = "        11        12"
BLOCK_FAULTS = [
    (
        "initial penetration",
        "       5           1.005",
        "       5             0.9",
        "       8           1.005",
        "       8             0.9",
    ),
    ("undefined side", CONTACT, "        11        19"),
    ("undefined node set side", CONTACT, "       -91        12"),
    ("two cards on the same parts", "*END", "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE\n" + CONTACT + "\n*END"),
    ("frame that is not available", "*END", "*BIPACT_CONTACT\n\n                 END\n*END"),
    ("tied contact", CONTACT + "\n", CONTACT + "\n\n                              1\n"),
    ("friction that rises", CONTACT, CONTACT + " " * 20 + "       0.1       0.3       1.0"),
    ("decay of friction", CONTACT, CONTACT + " " * 20 + "       0.3       0.1      -1.0"),
    ("negative friction", CONTACT, CONTACT + " " * 20 + "      -0.3"),
    ("viscous friction", CONTACT + "\n", CONTACT + "\n\n       1.0\n"),
    (
        "bad id",
        "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE\n",
        "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n        1x\n",
    ),
    (
        "id twice",
        "*END",
        "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n         1\n" + CONTACT + "\n*END",
    ),
    ("pair of no contact", "*END", "*BIPACT_PAIR\n         5         A\n*END"),
    ("pair with no side", "*END", "*BIPACT_PAIR\n         1      NONE\n*END"),
    ("pair twice", "*END", "*BIPACT_PAIR\n         1         A\n         1         B\n*END"),
    ("ramp without statics", "*END", "*BIPACT_PAIR\n         1,,,,,,,RAMP\n*END"),
    (
        "adjusted node set",
        CONTACT,
        "        -1        12",
        "*END",
        "*SET_NODE_LIST\n1,\n5,6\n*BIPACT_PAIR\n1,,,,,,,ADJUST\n*END",
    ),
    ("adjusted by both sides", "*END", "*BIPACT_PAIR\n1,BOTH,,,,,,ADJUST\n*END"),
    ("overlap of no such kind", "*END", "*BIPACT_PAIR\n1,,,,,,,PUSH\n*END"),
    ("mortar around an axis", "*END", "*BIPACT_PAIR\n1,,,,,MORTAR\n*END", *RING),
    ("mortar on both sides", "*END", "*BIPACT_PAIR\n1,BOTH,,,,MORTAR\n*END"),
    ("mortar of a node set", "*END", "*BIPACT_PAIR\n1,,,NODESET,,MORTAR\n*SET_NODE_LIST\n12,\n1,2\n*END"),
    ("mortar of one surface", "*END", "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE_ID\n7,\n,\n*BIPACT_PAIR\n7,,,,,MORTAR\n*END"),
    ("mortar of parts on both sides", "*END", "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n7,\n1,1\n*BIPACT_PAIR\n7,,PART,PART,,MORTAR\n*END"),
    ("pairing that is not available", "*END", "*BIPACT_PAIR\n         1,,,,,MORTARSTD\n*END"),
    ("pair of no segment set", "*END", "*BIPACT_PAIR\n         1         A    SEGSET\n*END"),
    (
        "wall without normal",
        "*END",
        "*RIGIDWALL_PLANAR\n\n       3.0                           3.0\n*END",
    ),
    (
        "wall in a body",
        "*END",
        "*RIGIDWALL_PLANAR\n\n       1.5                           0.0\n*END",
    ),
    ("wall of no nodes", "*END", "*RIGIDWALL_PLANAR\n        33\n       3.0\n*END"),
    (
        "welding wall",
        "*END",
        "*RIGIDWALL_PLANAR\n\n       3.0                           0.0                           2.0\n*END",
    ),
    (
        "moving wall without mass",
        "*END",
        "*RIGIDWALL_PLANAR_MOVING\n\n       3.0                           0.0\n*END",
    ),
    (
        "moving wall of no mass",
        "*END",
        "*RIGIDWALL_PLANAR_MOVING\n\n       3.0                           0.0\n       0.0       1.0\n*END",
    ),
    (
        "moving wall, WVEL",
        "*END",
        "*RIGIDWALL_PLANAR_MOVING\n\n       3.0                           0.0                                     1.0\n       1.0\n*END",
    ),
    (
        "cylinder across the plane",
        "*END",
        "*RIGIDWALL_GEOMETRIC_CYLINDER\n\n       5.0       0.0       0.0       6.0       1.0       0.0\n       1.0\n*END",
    ),
    (
        "cylinder without radius",
        "*END",
        "*RIGIDWALL_GEOMETRIC_CYLINDER\n\n       5.0       0.0       0.0       5.0       0.0       1.0\n\n*END",
    ),
    (
        "cylinder of finite length",
        "*END",
        "*RIGIDWALL_GEOMETRIC_CYLINDER\n\n       5.0       0.0       0.0       5.0       0.0       1.0\n       1.0       2.0\n*END",
    ),
    (
        "bowl around half a body",
        "*END",
        "*RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR\n\n       1.0       0.0       0.0       1.0       0.0       1.0\n      1.01\n*END",
    ),
    (
        "flat wall that leans",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT\n\n       3.0                           0.0\n       3.5       1.0       0.0       2.0\n*END",
    ),
    (
        "flat wall whose end is its start",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT\n\n       3.0                           0.0\n       3.0       0.0       0.0       2.0\n*END",
    ),
    (
        "flat wall out of the plane",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT\n\n       3.0                           0.0\n       3.0       1.0       1.0       2.0\n*END",
    ),
    (
        "flat wall along z",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT\n\n       3.0                           0.0\n                                               2.0\n*END",
    ),
    (
        "moved wall without curve",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n\n       3.0                           0.0\n       0.0\n        77         0       1.0\n*END",
    ),
    (
        "moved wall without direction",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n\n       3.0                           0.0\n       0.0\n         1         0\n*DEFINE_CURVE\n1,\n0.0,0.0\n1.0,1.0\n*END",
    ),
    (
        "moved wall that starts elsewhere",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n\n       3.0                           0.0\n       0.0\n         1         1       1.0\n*DEFINE_CURVE\n1,\n0.0,0.5\n1.0,1.0\n*END",
    ),
    (
        "wall moved by its acceleration",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n\n       3.0                           0.0\n       0.0\n         1         2       1.0\n*DEFINE_CURVE\n1,\n0.0,0.0\n1.0,1.0\n*END",
    ),
    (
        "wall with two numbers",
        "*END",
        "*RIGIDWALL_GEOMETRIC_FLAT_ID\n         3\n\n       3.0                           0.0\n\n*RIGIDWALL_PLANAR_ID\n         3\n\n       3.0                           0.0\n*END",
    ),
    (
        "moving wall in statics",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1\n",
        "*CONTROL_IMPLICIT_DYNAMICS\n         1                         0.005\n",
        "*END",
        "*RIGIDWALL_PLANAR_MOVING\n\n       3.0                           0.0\n       1.0\n*END",
    ),
    ("surface of no part set", "*END", "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE\n        19\n*END"),
    (
        "corner of a body in another",
        "       5           1.005             0.0",
        "       5             0.9             0.2",
    ),
]

# name, main deck, other files, options
# Faults of space.k.
FIRST = "       1       1       1       2       5       4       7       8      11      10"
SECOND = "       2       1       2       3       6       5       8       9      12      11"
FORM = "*SECTION_SOLID\n         1         2"
SEGMENT = "         7         8        11        10"
SPACE_FAULTS = [
    ("incompatible modes at finite deformation", "*END", FINITE + "*END",
     "*SECTION_SOLID\n         1         2", "*SECTION_SOLID\n         1        -1"),
    ("nodes that repeat otherwise", FIRST, "1,1,1,2,5,4,7,7,11,10"),
    ("a hexahedron of four nodes", FIRST, "1,1,1,2,5,4"),
    ("one node twice in a tetrahedron", SECOND, "2,1,2,3,3,8,8,8,8,8"),
    ("two cards where one was begun", SECOND, "2,1\n2,3,6,5,8,9,12,11"),
    ("one card where two were begun", FIRST, "1,1\n1,2,5,4,7,8,11,10"),
    ("ten nodes", FIRST + "\n" + SECOND, "1,1\n1,2,5,4,7,8,11,10,3,6"),
    ("a node of a solid that is not there", FIRST, FIRST.replace(" 11 ", " 13 ")),
    ("a solid of a part that is not there", FIRST, "1,2,1,2,5,4,7,8,11,10"),
    ("a solid twice", SECOND, SECOND.replace("       2", "       1", 1)),
    ("a solid inside out", FIRST, "1,1,7,8,11,10,1,2,5,4"),
    ("a flat solid", "      10             0.0             1.0             1.0",
     "      10             0.0             0.0             1.0"),
    ("three elements at one face", SECOND, SECOND + "\n3,1,2,3,6,5,8,9,12,11"),
    ("a triangle on half a quadrilateral", SECOND, "2,1,2,3,5,8,8,8,8,8"),
    ("shells beside solids", "*PART", "*ELEMENT_SHELL\n3,1,1,2,5,4\n*PART"),
    ("a section of shells for solids", FORM, "*SECTION_SHELL\n         1        13                   4\n       1.0"),
    ("a form with rotations", FORM, FORM[:-1] + "3"),
    ("twenty nodes", FORM, FORM[:-2] + "23"),
    ("quadratic tetrahedra", FORM, FORM[:-2] + "16"),
    ("an unknown form", FORM, FORM[:-2] + "99"),
    ("hexahedra in a part of tetrahedra", FORM, FORM[:-2] + "10"),
    ("hexahedra in a part of wedges", FORM, FORM[:-2] + "15"),
    ("ambient elements", FORM, FORM + "         5"),
    ("an element card of twenty nodes", "*PART", "*ELEMENT_SOLID_H20\n*PART"),
    ("a rigid part in space", "*MAT_ELASTIC\n" + MATERIAL, "*MAT_RIGID\n         1     0.001\n\n"),
    ("plane contact in space", "*END", "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE\n0,\n\n*END"),
    ("a surface of shells in space", "*END", "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,1,1,3\n*END"),
    ("a missing part in contact", "*END", "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,9,3,3\n*END"),
    ("a node set as obstacle", "*END", "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,1,3,4\n*END"),
    ("segments of a single surface", "*END", "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n1,0,0\n*END"),
    ("a thickness of solids", "*END", "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,\n0.1,\n1.0,1.0,0.5\n*END"),
    ("mortar in space", "*END", "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,\n*BIPACT_PAIR\n1,,,,,MORTAR\n*END"),
    ("a ramp in space", "*END", "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,1,3,3\n*BIPACT_PAIR\n1,,,,,,,RAMP\n*END"),
    ("a rigid part that moves freely", "*MAT_ELASTIC\n" + MATERIAL,
     "*MAT_RIGID\n         1     0.001     100.0       0.3\n1.0,4,7\n0.0,"),
    ("a wall with ends in space", "*END", "*RIGIDWALL_GEOMETRIC_FLAT\n0,\n0,0,0,0,1,0\n1,0,0,2\n*END"),
    ("a cylinder in space", "*END", "*RIGIDWALL_GEOMETRIC_CYLINDER\n0,\n0,0,0,0,0,1\n1,\n*END"),
    ("a segment of two nodes in space", SEGMENT, "7,8"),
    ("a segment inside", SEGMENT, "2,5,11,8"),
    ("a segment of four nodes of two faces", SEGMENT, "7,8,11,4"),
    ("a pressure inside", "*END", "*LOAD_SEGMENT\n1,1.0,,2,5,11,8\n*END"),
    ("a clause for a face inside", "*END", "*SET_SEGMENT_GENERAL\n2,\nSEG,2,5,11,8\n*END"),
    ("a segment of a node twice", SEGMENT, "7,8,8,10"),
    ("direction 4 in space", "*END", "*LOAD_NODE_SET\n1,4,1\n*END"),
    ("triangles with the mass DISPERSION in space", FIRST + "\n" + SECOND,
     "1,1,1,2,5,4,7,8,11,10\n2,1,2,3,5,8,8,8,8,8", "*END", "*BIPACT_MASS\nDISPERSION\n*END"),
]

FILE_FAULTS = [
    (
        "fault in an include",
        BASES["base"].replace("*END", "*INCLUDE\nmore.k\n*END"),
        {
            "more.k": "*INCLUDE\ndeeper.k\n*END\n",
            "deeper.k": "*DATABASE_NODOUT\n     -0.1\n*END\n",
        },
        [],
    ),
    (
        "defined in two files",
        BASES["base"].replace("*END", "*INCLUDE\nmore.k\n*END"),
        {"more.k": "*NODE\n" + NODE + "\n*END\n"},
        [],
    ),
    (
        "includes in a circle",
        BASES["base"].replace("*END", "*INCLUDE\nmore.k\n*END"),
        {"more.k": "*INCLUDE\nmore.k\n*END\n"},
        [],
    ),
    ("-D of a name that is not there", BASES["base"], {}, ["-D", "tond=1.0"]),
    ("-D of no number", BASES["base"], {}, ["-D", "tend=soon"]),
    ("-D out of range", BASES["base"], {}, ["-D", "dt=-1.0"]),
    ("an empty deck", "", {}, []),
    ("no deck at all", "\0\1\2\3 these are no cards", {}, []),
    (
        "more than twenty problems",
        BASES["base"].replace("*END", "*NODE\n" + 30 * "       x\n" + "*END"),
        {},
        [],
    ),
]


def changed(base, fault):
    """Text of a deck with a fault."""
    for old, new in zip(fault[1::2], fault[2::2]):
        if old not in base:
            raise SystemExit("fault '%s' does not fit its deck" % fault[0])
        base = base.replace(old, new, 1)
    return base


def message(name, text, folder, files=(), options=()):
    """Exit code and messages of a deck, with the scratch folder taken out."""
    deck = os.path.join(folder, "deck.k")
    for path, content in [("deck.k", text)] + list(dict(files).items()):
        with open(os.path.join(folder, path), "w", newline="", encoding="utf-8") as out:
            out.write(content)
    shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
    done = subprocess.run(
        [os.environ["BIPACT"], deck, "-o", os.path.join(folder, "out")] + list(options),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
    )
    wrote = os.path.exists(os.path.join(folder, "out"))
    return "== %s\nexit %d%s\n%s" % (
        name,
        done.returncode,
        ", WROTE FILES" if wrote else "",
        done.stderr.replace(folder + "/", ""),
    )


def main():
    folder = os.environ["TMP"]
    found = [message(f[0], changed(BASES["base"], f), folder) for f in BASE_FAULTS]
    found += [message(f[0], changed(BASES["two_blocks"], f), folder) for f in BLOCK_FAULTS]
    found += [message(f[0], changed(BASES["space"], f), folder) for f in SPACE_FAULTS]
    found += [
        message(name, text, folder, files, options)
        for name, text, files, options in FILE_FAULTS
    ]
    path = os.path.join(HERE, "expected.txt")
    if "--write" in sys.argv:
        with open(path, "w") as out:
            out.write("".join(found))
        return 0
    expected = open(path).read().split("== ")[1:]
    failed = len(expected) != len(found)
    for k, text in enumerate(found):
        wanted = "== " + expected[k] if k < len(expected) else "(nothing)"
        if text != wanted or "exit 2\n" not in text:
            failed += 1
            print("FAIL %s--- expected\n%s--- found\n%s" % (text.split("\n")[0], wanted, text))
    for name, text in BASES.items():
        good = message(name, text, folder)
        if "exit 0" not in good:
            failed += 1
            print("FAIL the deck without a fault: " + good)
    print("%d passed, %d failed" % (len(found) + len(BASES) - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
