"""Layouts of cards as several writers of decks fill them: the fields of each card in their
order, with the value that stands there by default. Widths are 10 unless said."""

SOLVER = "da1=0.0 da2=0.0 da3=0.0 da4=0.0 solver=MECH its=1"


def members(name, count=8):
    return " ".join("%s%d=0" % (name, k + 1) for k in range(count))


# keyword: its cards; "*" after a card: it may be repeated; "text" alone: a line of text
LAYOUT = {
    "TITLE": ["text"],
    "CONTROL_TERMINATION": [
        "endtim=0.0 endcyc=0 dtmin=0.0 endeng=0.0 endmas=1.000E+08 nosol=0"
    ],
    "CONTROL_IMPLICIT_GENERAL": [
        "imflag=0 dt0=0.0 imform=2 nsbs=1 igs=2 cnstn=0 form=0 zero_v=0"
    ],
    "CONTROL_IMPLICIT_DYNAMICS": [
        "imass=0 gamma=0.0 beta=0.0 tdybir=0.0 tdydth=1.00E+28 tdybur=1.00E+28 irate=0 "
        "alpha=0.0"
    ],
    "CONTROL_IMPLICIT_SOLUTION": [
        "nsolvr=1 ilimit=11 maxref=15 dctol=0.001 ectol=0.01 rctol=1.000E+10 lstol=0.9 "
        "abstol=1.00E-10",
        "dnorm=2 diverg=1 istif=1 nlprint=0 nlnorm=2.0 d3itctl=0 cpchk=0",
        "arcctl=0 arcdir=0 arclen=0.0 arcmth=1 arcdmp=2 arcpsi=0.0 arcalf=0.0 arctim=0.0",
        "lsmtd=4 lsdir=2 irad=0.0 srad=0.0 awgt=0.0 sred=0.0",
    ],
    "CONTROL_IMPLICIT_SOLVER": [
        "lsolvr=2 lprint=0 negev=2 order=0 drcm=4 drcprm=0.0 autospc=1 autotol=0.0",
        "lcpack=2 mtxdmp=0 iparm1=500 rparm1=1.00E-09 rparm2=0.001",
    ],
    "CONTROL_IMPLICIT_AUTO": [
        "iauto=0 iteopt=11 itewin=5 dtmin=0.0 dtmax=0.0 dtexp=0.0 kfail=0 kcycle=0"
    ],
    "CONTROL_TIMESTEP": [
        "dtinit=0.0 tssfac=0.9 isdo=0 tslimt=0.0 dt2ms=0.0 lctm=0 erode=0 ms1st=0",
        "dt2msf=0.0 dt2mslc=0 imscl=0 unused= unused= rmscl=0.0",
    ],
    "CONTROL_ENERGY": ["hgen=1 rwen=2 slnten=1 rylen=1"],
    "CONTROL_OUTPUT": [
        "npopt=0 neecho=0 nrefup=0 iaccop=0 opifs=0.0 ipnint=0 ikedit=100 iflush=5000",
        "iprtf=0 ierode=0 tet10s8=2 msgmax=50 ipcurv=0 gmdt=0.0 ip1dblt=0 eocs=0",
    ],
    "CONTROL_SOLUTION": ["soln=0 nlq=0 isnan=0 lcint=100 lcacc=0 ncdcf=1"],
    "CONTROL_ACCURACY": ["osu=0 inn=1 pidosu=0 iacc=0"],
    "CONTROL_BULK_VISCOSITY": ["q1=1.5 q2=0.06 type=1"],
    "CONTROL_CONTACT": [
        "slsfac=0.1 rwpnal=0.0 islchk=1 shlthk=0 penopt=1 thkchg=0 orien=1 enmass=0",
        "usrstr=0 usrfrc=0 nsbcs=10 interm=0 xpene=4.0 ssthk=0 ecdt=0 tiedprj=0",
        "sfric=0.0 dfric=0.0 edc=0.0 vfc=0.0 th=0.0 th_sf=0.0 pen_sf=0.0",
        "ignore=0 frceng=0 skiprwg=0 outseg=0 spotstp=0 spotdel=0 spothin=0.0",
    ],
    "CONTROL_HOURGLASS": ["ihq=1 qh=0.1"],
    "CONTROL_SHELL": [
        "wrpang=20.0 esort=0 irnxx=-1 istupd=0 theory=2 bwc=2 miter=1 proj=0",
        "rotascl=1.0 intgrd=0 lamsht=0 cstyp6=1 thshel=0",
    ],
    "CONTROL_STRUCTURED": [],
    "CONTROL_PARALLEL": ["ncpu=1 numrhs=0 const=2 para=0"],
    "CONTROL_CPU": ["cputim=0.0"],
    "CONTROL_DYNAMIC_RELAXATION": [
        "nrcyck=250 drtol=0.001 drfctr=0.995 drterm=0.0 tssfdr=0.0 irelal=0 edttl=0.04 idrflg=0"
    ],
    "HOURGLASS": ["hgid=0 ihq=1 qm=0.1 ibq=0 q1=1.5 q2=0.06 qb/vdc=0.1 qw=0.1"],
    "SECTION_SHELL": [
        "secid=0 elform=2 shrf=1.0 nip=2 propt=1.0 qr/irid=0 icomp=0 setyp=1",
        "t1=0.0 t2=0.0 t3=0.0 t4=0.0 nloc=0.0 marea=0.0 idof=0.0 edgset=0",
    ],
    "SECTION_SOLID": ["secid=0 elform=1 aet=0"],
    "MAT_ELASTIC": ["mid=0 ro=0.0 e=0.0 pr=0.0 da=0.0 db=0.0 not_used=0"],
    "MAT_RIGID": [
        "mid=0 ro=0.0 e=0.0 pr=0.0 n=0.0 couple=0.0 m=0.0 alias=",
        "cmo=0.0 con1=0 con2=0",
        "lco_or_a1=0.0 a2=0.0 a3=0.0 v1=0.0 v2=0.0 v3=0.0",
    ],
    "MAT_NULL": ["mid=0 ro=0.0 pc=0.0 mu=0.0 terod=0.0 cerod=0.0 ym=0.0 pr=0.0"],
    "MAT_PIECEWISE_LINEAR_PLASTICITY": [
        "mid=0 ro=0.0 e=0.0 pr=0.0 sigy=0.0 etan=0.0 fail=1.000E+21 tdel=0.0",
        "c=0.0 p=0.0 lcss=0 lcsr=0 vp=0.0",
        "eps1=0.0 eps2=0.0 eps3=0.0 eps4=0.0 eps5=0.0 eps6=0.0 eps7=0.0 eps8=0.0",
        "es1=0.0 es2=0.0 es3=0.0 es4=0.0 es5=0.0 es6=0.0 es7=0.0 es8=0.0",
    ],
    "MAT_USER_DEFINED_MATERIAL_MODELS": [
        "mid=0 ro=0.0 mt=41 lmc=8 nhv=0 iortho=0 ibulk=1 ig=2",
        "ivect=0 ifail=0 itherm=0 ihyper=0 ieos=0 lmca=0",
        "p1=0.0 p2=0.0 p3=0.0 p4=0.0 p5=0.0 p6=0.0 p7=0.0 p8=0.0",
    ],
    "PART": ["text", "pid=0 secid=0 mid=0 eosid=0 hgid=0 grav=0 adpopt=0 tmid=0"],
    "NODE": ["nid:8=0 x:16=0.0 y:16=0.0 z:16=0.0 tc:8=0 rc:8=0*"],
    "ELEMENT_SHELL": [
        "eid:8=0 pid:8=0 n1:8=0 n2:8=0 n3:8=0 n4:8=0 n5:8=0 n6:8=0 n7:8=0 n8:8=0*"
    ],
    "ELEMENT_SOLID": [
        "eid:8=0 pid:8=0 n1:8=0 n2:8=0 n3:8=0 n4:8=0 n5:8=0 n6:8=0 n7:8=0 n8:8=0*"
    ],
    "SET_NODE_LIST": ["sid=0 " + SOLVER, members("nid") + "*"],
    "SET_PART_LIST": ["sid=0 " + SOLVER, members("pid") + "*"],
    "SET_SHELL_LIST": ["sid=0 " + SOLVER, members("eid") + "*"],
    "SET_SEGMENT": ["sid=0 " + SOLVER, "n1=0 n2=0 n3=0 n4=0 a1=0.0 a2=0.0 a3=0.0 a4=0.0*"],
    "SET_NODE_GENERAL": ["sid=0 " + SOLVER, "option=ALL " + members("e", 7) + "*"],
    "DEFINE_BOX": ["boxid=0 xmn=0.0 xmx=0.0 ymn=0.0 ymx=0.0 zmn=0.0 zmx=0.0"],
    "DEFINE_CURVE": [
        "lcid=0 sidr=0 sfa=1.0 sfo=1.0 offa=0.0 offo=0.0 dattyp=0 lcint=0",
        "a1:20=0.0 o1:20=0.0*",
    ],
    "BOUNDARY_SPC_SET": ["nsid=0 cid=0 dofx=0 dofy=0 dofz=0 dofrx=0 dofry=0 dofrz=0*"],
    "BOUNDARY_SPC_NODE": ["nid=0 cid=0 dofx=0 dofy=0 dofz=0 dofrx=0 dofry=0 dofrz=0*"],
    "BOUNDARY_PRESCRIBED_MOTION_SET": [
        "nsid=0 dof=0 vad=0 lcid=0 sf=1.0 vid=0 death=1.000E+28 birth=0.0*"
    ],
    "BOUNDARY_PRESCRIBED_MOTION_NODE": [
        "nid=0 dof=0 vad=0 lcid=0 sf=1.0 vid=0 death=1.000E+28 birth=0.0*"
    ],
    "BOUNDARY_PRESCRIBED_MOTION_RIGID": [
        "pid=0 dof=0 vad=0 lcid=0 sf=1.0 vid=0 death=1.000E+28 birth=0.0*"
    ],
    "INITIAL_VELOCITY_GENERATION": [
        "id=0 styp=1 omega=0.0 vx=0.0 vy=0.0 vz=0.0 ivatn=0 icid=0",
        "xc=0.0 yc=0.0 zc=0.0 nx=0.0 ny=0.0 nz=0.0 phase=0 irigid=0",
    ],
    "INITIAL_VELOCITY_NODE": ["nid=0 vx=0.0 vy=0.0 vz=0.0 vxr=0.0 vyr=0.0 vzr=0.0 icid=0*"],
    "INITIAL_VELOCITY": [
        "nsid=0 nsidex=0 boxid=0 irigid=0 icid=0",
        "vx=0.0 vy=0.0 vz=0.0 vxr=0.0 vyr=0.0 vzr=0.0",
    ],
    "LOAD_BODY_Y": ["lcid=0 sf=1.0 lciddr=0 xc=0.0 yc=0.0 zc=0.0 cid=0"],
    "LOAD_SEGMENT_SET": ["ssid=0 lcid=0 sf=1.0 at=0.0*"],
    "LOAD_NODE_SET": ["nsid=0 dof=0 lcid=0 sf=1.0 cid=0 m1=0 m2=0 m3=0*"],
    "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE": [
        "surfa=0 surfb=0 sfact=1.0 freq=50 fs=0.0 fd=0.0 dc=0.0",
        "tbirth=0.0 tdeath=1.000E+20 soa=1.0 sob=1.0 nda=0 ndb=0 cof=0 init=0",
        "vc=0.0 vdc=10.0 ipf=0 slide=0 istiff=0 tiedgap=0.0 igapcl=0 tietyp=0",
    ],
    "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE": [
        "surfa=0 surfb=0 surfatyp=0 surfbtyp=0 saboxid=0 sbboxid=0 sapr=0 sbpr=0",
        "fs=0.0 fd=0.0 dc=0.0 vc=0.0 vdc=0.0 penchk=0 bt=0.0 dt=1.000E+20",
        "sfsa=1.0 sfsb=1.0 sast=0.0 sbst=0.0 sfsat=1.0 sfsbt=1.0 fsf=1.0 vsf=1.0",
    ],
    "CONTACT_AUTOMATIC_SINGLE_SURFACE": [
        "surfa=0 surfb=0 surfatyp=2 surfbtyp=0 saboxid=0 sbboxid=0 sapr=0 sbpr=0",
        "fs=0.0 fd=0.0 dc=0.0 vc=0.0 vdc=0.0 penchk=0 bt=0.0 dt=1.000E+20",
        "sfsa=1.0 sfsb=1.0 sast=0.0 sbst=0.0 sfsat=1.0 sfsbt=1.0 fsf=1.0 vsf=1.0",
    ],
    "RIGIDWALL_PLANAR": [
        "nsid=0 nsidex=0 boxid=0 offset=0.0 birth=0.0 death=1.000E+20 rwksf=1.0",
        "xt=0.0 yt=0.0 zt=0.0 xh=0.0 yh=0.0 zh=0.0 fric=0.0 wvel=0.0",
    ],
    "DATABASE_BINARY_D3PLOT": [
        "dt=0.0 lcdt=0 beam=0 npltc=0 psetid=0",
        "ioopt=0 rate=0.0 cutoff=0.0 window=0.0 type=0 pset=0",
    ],
    "DATABASE_BINARY_D3THDT": ["dt=0.0 lcdt=0"],
    "DATABASE_EXTENT_BINARY": [
        "neiph=0 neips=0 maxint=3 strflg=0 sigflg=1 epsflg=1 rltflg=1 engflg=1",
        "cmpflg=0 ieverp=0 beamip=0 dcomp=1 shge=1 stssz=1 n3thdt=2 ialemat=1",
    ],
    "DATABASE_NODOUT": ["dt=0.0 binary=0 lcur=0 ioopt=1 option1=0.0 option2=0"],
    "DATABASE_ELOUT": [
        "dt=0.0 binary=0 lcur=0 ioopt=1 option1=0 option2=0 option3=0 option4=0"
    ],
    "DATABASE_HISTORY_NODE": [members("id") + "*"],
    "DATABASE_HISTORY_NODE_SET": [members("id") + "*"],
    "DATABASE_HISTORY_SHELL": [members("id") + "*"],
    "DATABASE_HISTORY_BEAM": [members("id") + "*"],
    "DAMPING_GLOBAL": ["lcid=0 valdmp=0.0 stx=0.0 sty=0.0 stz=0.0 srx=0.0 sry=0.0 srz=0.0"],
    "BIPACT_TIME": ["scheme=THETA theta= xi="],
}
for table in "GLSTAT MATSUM RCFORC SLEOUT SPCFORC RWFORC RBDOUT SECFORC ABSTAT TPRINT".split():
    LAYOUT["DATABASE_" + table] = ["dt=0.0 binary=0 lcur=0 ioopt=1"]


def fields_of(card):
    """[(name, width, value by default)] of a card."""
    found = []
    for word in card.rstrip("*").split():
        name, _, value = word.partition("=")
        name, _, width = name.partition(":")
        found.append((name, int(width or 10), value))
    return found
