# Reads Fortran sources, checks the layer rules, and writes the dependencies for make.
#
#   awk -f mkdeps.awk src/*/*.f90 build/FLAVOUR/gen/*.f90 tests/support/*.f90 tests/unit/*.f90 bench/*.f90 \
#       examples/*.f90
#
# An object depends on the .mod files of the modules it uses. A .mod depends on its object with a
# recipe that does nothing: gfortran leaves an unchanged .mod untouched, so that a change inside a
# procedure recompiles one file and a change of an interface recompiles its users.

BEGIN {
  # Lowest first. A layer may use itself and all lower ones, unless `only` or `never` says less.
  n = split("base linalg cone hdf5 fclib deck material element solid model scene contact assembly time output run" \
            " store mpi", \
            order, " ")
  for (i = 1; i <= n; i++) rank[order[i]] = i
  only["cone"] = " base linalg "        # the contact solver is usable without the rest
  only["hdf5"] = " base "
  only["fclib"] = " base linalg cone hdf5 "  # its program reads files of contact problems
  only["deck"] = " base linalg cone "   # the reader knows solvers by name, and no mechanics
  never["contact"] = " material element "

  main["src/run/main.f90"]
  main["src/fclib/fclib_main.f90"]
  main["src/store/store_main.f90"]
  main["src/mpi/mpi_main.f90"]
  for (i = 1; i < ARGC; i++) register(ARGV[i])
}

function fail(where, message) {
  print where ": error: " message > "/dev/stderr"
  failed = 1
}

function register(path,   part, n, name, folder) {
  n = split(path, part, "/")
  name = part[n]
  folder = part[n - 1]
  sub(/\.[fF]90$/, "", name)
  if (name in source) fail(path, "a file of this name exists already: " source[name])
  source[name] = path
  name_of[path] = name
  if (path ~ /^(tests|bench|examples)\//) return  # these may use everything
  layer[path] = (folder == "gen") ? "base" : folder
  if (!(layer[path] in rank))
    fail(path, "folder " folder " is not a layer; the layers are listed in scripts/mkdeps.awk")
  else if (!(path in main) && index(name, layer[path] "_") != 1)
    fail(path, "the file name must begin with its folder: " layer[path] "_...")
}

{
  text = tolower($0)
  sub(/[!\r].*/, "", text)
  words = split(text, word, " ")
}

words == 2 && word[1] == "program" {
  if (layer[FILENAME] != "" && !(FILENAME in main))
    fail(FILENAME ":" FNR, "a program belongs to src/run/main.f90, src/fclib/fclib_main.f90, src/store/store_main.f90 or src/mpi/mpi_main.f90")
  program[FILENAME] = word[2]
}

words == 2 && word[1] == "module" && FILENAME !~ /^(tests\/unit|bench|examples)\// {
  if (FILENAME in module) fail(FILENAME ":" FNR, "a file holds one module")
  else if (word[2] != name_of[FILENAME])
    fail(FILENAME ":" FNR, "module " word[2] " must have the name of its file")
  module[FILENAME] = word[2]
}

text ~ /^[ \t]*use([ \t]*,[ \t]*(non_)?intrinsic[ \t]*|[ \t]*)(::[ \t]*|[ \t])[a-z]/ {
  sub(/^[ \t]*use[ \t]*(,[ \t]*(non_)?intrinsic)?[ \t]*(::)?[ \t]*/, "", text)
  sub(/[^a-z0-9_].*/, "", text)
  if (text ~ /^(iso_c_binding|iso_fortran_env|ieee_.*|omp_lib|hdf5)$/) next
  if (text == "mpi_f08" && layer[FILENAME] == "mpi") next
  if ((FILENAME, text) in line_of) next
  line_of[FILENAME, text] = FNR
  used[FILENAME] = used[FILENAME] " " text
}

function check_use(path, name,   where, from, to) {
  where = path ":" line_of[path, name]
  if (!(name in source)) { fail(where, "no source holds module " name); return }
  if (name == name_of[path]) { fail(where, "module " name " uses itself"); return }
  if (path ~ /^(tests|bench|examples)\//) return
  from = layer[path]
  to = layer[source[name]]
  if (to == "") fail(where, "a source may not use " name " of the tests")
  else if (from == to) return
  else if (to == "hdf5" && from != "fclib" && from != "store" && from != "mpi")
    fail(where, "layer hdf5 is for fclib, store and mpi alone: bipact starts without the library")
  else if (rank[to] > rank[from] || (from in only && !index(only[from], " " to " ")) \
           || (from in never && index(never[from], " " to " ")))
    fail(where, "layer " from " may not use " name " of layer " to)
}

END {
  for (i = 1; i < ARGC; i++) {
    path = ARGV[i]
    name = name_of[path]
    if (path in main || path ~ /^(tests\/unit|bench|examples)\//) {
      if (!(path in program)) fail(path, "no program statement found")
    } else if (!(path in module)) fail(path, "no module statement found")

    rule = "$(B)/obj/" name ".o: " path " $(B)/flags"
    n = split(used[path], list, " ")
    for (k = 1; k <= n; k++) {
      check_use(path, list[k])
      rule = rule " $(B)/mod/" list[k] ".mod"
    }
    output = output rule "\n\t$(compile)\n"
    if (path in module) output = output "$(B)/mod/" name ".mod: $(B)/obj/" name ".o ; @:\n"
  }
  if (failed) exit 1
  printf "%s", output
}
