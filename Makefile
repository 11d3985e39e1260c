# Build, test and demonstrate bipact. `make help` lists the targets.
# Sources and tests are found by wildcard: a new file needs no edit here.
# Local choices (compiler, flags, libraries) go to config.mk, see config.mk.example.

-include config.mk

FLAVOUR ?= release
PYTHON3 ?= python3
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
ifeq ($(origin FC),default)
FC := gfortran
endif

B := build/$(FLAVOUR)
BIN := bin/bipact$(if $(filter-out release,$(FLAVOUR)),-$(FLAVOUR))
STORE_BIN := bin/bipact-hdf5$(if $(filter-out release,$(FLAVOUR)),-$(FLAVOUR))
FCLIB_BIN := bin/bipact-fclib$(if $(filter-out release,$(FLAVOUR)),-$(FLAVOUR))
MPI_BIN := bin/bipact-mpi$(if $(filter-out release,$(FLAVOUR)),-$(FLAVOUR))
LIB := $(B)/libbipact.a
SUPPORT := $(B)/libsupport.a
example-programs := $(patsubst examples/%.f90,$(B)/examples/%,$(wildcard examples/*.f90))
# HDF5, for bipact-hdf5 and bipact-fclib alone: Debian keeps it under hdf5/serial and calls it _serial.
HDF5_MODULES ?= $(firstword $(patsubst %/hdf5.mod,%,$(wildcard /usr/include/hdf5/serial/hdf5.mod \
                /usr/include/hdf5.mod /usr/lib64/gfortran/modules/hdf5.mod)))
# MPI and MUMPS, for bipact-mpi alone: the compiler of the distribution's MPI tells its flags.
MPIFC ?= mpifort
MUMPS_INCLUDE ?= $(patsubst %/dmumps_struc.h,%,$(firstword $(wildcard /usr/include/dmumps_struc.h \
                 /usr/include/MUMPS/dmumps_struc.h /usr/local/include/dmumps_struc.h)))
MPI_FLAGS ?= $(shell $(MPIFC) --showme:compile 2>/dev/null)
MPI_LIBS ?= $(addprefix -l,dmumps mumps_common pord metis lapack blas) $(shell $(MPIFC) --showme:link 2>/dev/null)
has-mpi := $(if $(HDF5_MODULES),$(if $(MUMPS_INCLUDE),$(if $(shell command -v $(MPIFC) 2>/dev/null),1)))
Q := $(if $(V),,@)
comma := ,

.DELETE_ON_ERROR:
.SUFFIXES:
.DEFAULT_GOAL := all
.PHONY: all no-hdf5 no-mpi demo test test-unit test-programs bench-programs examples example-programs check-style doc deps venv gmsh debug \
        sanitize fuzz collide bench bench-features bench-fclib report stability \
        install uninstall clean distclean help FORCE

# ---------------------------------------------------------------- targets for people

# These read neither the compiler nor the sources: they must work on a machine that has no gfortran
# yet. What needs a compiler runs in a second make, started after the installation.
light := demo test test-unit examples check-style doc deps venv gmsh debug sanitize fuzz collide bench bench-features bench-fclib \
         report stability install uninstall clean distclean help
again = $(MAKE) --no-print-directory $(if $(findstring jobserver,$(MAKEFLAGS)),,-j$(JOBS))

all: $(BIN) $(if $(wildcard src/hdf5/*.f90),$(if $(HDF5_MODULES),$(STORE_BIN) $(FCLIB_BIN),no-hdf5)) \
     $(if $(wildcard src/mpi/*.f90),$(if $(has-mpi),$(MPI_BIN),no-mpi)) ## build bin/bipact and its companions bipact-hdf5, -fclib, -mpi (FLAVOUR=release|debug|sanitize, ARCH=native, WERROR=1, V=1)

no-hdf5:
	@echo 'bipact-hdf5 (fields, restarts) and bipact-fclib are left out: no HDF5 modules for Fortran; "make deps" installs them'

no-mpi:
	@echo 'bipact-mpi (several ranks) is left out: it needs MPI with its Fortran compiler, MUMPS and HDF5; "make deps" installs them'

demo: ## install what is missing, build, run the two-bar impact and draw its figures
	+@$(again) venv
	+@$(again) all
	@.venv/bin/python scripts/demo.py

test: ## install what is missing, build, run every test
	+@$(again) venv
	+@$(again) WERROR=1 all test-programs example-programs
	@FLAVOUR=$(FLAVOUR) tests/run.sh

test-unit: ## build and run the unit tests only
	+@$(again) test-programs
	@FLAVOUR=$(FLAVOUR) tests/run.sh unit/

examples: ## build the examples of the library and run them
	+@$(again) example-programs
	@for program in $(example-programs); do echo "$$program"; $$program || exit 1; done

check-style: ## check the layout rules of sources and scripts
	@$(PYTHON3) scripts/check_style.py

doc: ## regenerate the generated pages of doc/
	+@$(again) all
	@if [ -x scripts/make_doc.sh ]; then scripts/make_doc.sh; else echo "doc: nothing to generate"; fi

fuzz: ## run N (20000) damaged decks; SEED=1
	+@$(again) all
	@BIPACT=$(BIN) $(PYTHON3) tests/fuzz/fuzz.py --count $(or $(N),20000) --seed $(or $(SEED),1) \
	  --keep build/fuzz

collide: ## run N (200) random collisions each: deformable, with rigid parts, with mortars, soft at finite deformation, in space; SEED=1, FRESH=1
	+@$(again) venv
	+@$(again) all
	@failed=0; for kind in plain rigid mortar soft; do \
	  echo "$$kind"; BIPACT=$(BIN) .venv/bin/python scripts/collide.py $(or $(N),200) \
	  --seed $(or $(SEED),1) $(if $(FRESH),--fresh) --out build/collide/$$kind \
	  $$(test $$kind = plain || echo --$$kind) || failed=1; done; \
	  for kind in space "space, soft"; do echo "$$kind"; \
	  .venv/bin/python scripts/collide_space.py $(or $(N),200) --bin $(BIN) --seed $(or $(SEED),1) \
	  $$(test "$$kind" = space || echo --soft) || failed=1; done; exit $$failed

bench: ## measure speed and accuracy of the two-bar impact and of the reader
	+@$(again) all bench-programs
	@if [ -x bench/run_bench.sh ]; then bench/run_bench.sh; else echo "bench: nothing to run"; fi

bench-features: ## what each feature costs absent, idle, active (instruction counts need valgrind)
	+@$(again) all
	@.venv/bin/python bench/features.py

bench-fclib: ## all contact solvers over FCLIB=dir of problems; SOLVERS=AUTO,GS,...; SICONOS=/usr/bin/python3 beside them
	+@$(again) venv
	+@$(again) all
	@.venv/bin/python bench/contact_problems.py $(or $(FCLIB),../shared/fclib) \
	  $(if $(SOLVERS),--solvers $(SOLVERS)) $(if $(SICONOS),--siconos $(SICONOS)) $(if $(OUT),--out $(OUT))

report: ## error against run time, to doc/report; QUICK=1: to build; REDUCED=1: part of it; PEERS=1; STATIC=1; SPACE=1; FINITE=1
	+@$(again) venv
	+@$(again) all
	@.venv/bin/python bench/report.py $(if $(QUICK),--quick) $(if $(REDUCED),--reduced) \
	  $(if $(PEERS),--peers) $(if $(STATIC),--static) $(if $(SPACE),--space) $(if $(FINITE),--finite) $(if $(FRESH),--fresh)

stability: ## the stability atlas on stiff and extreme cases, to doc/stability; QUICK=1: to build; REDUCED=1; ONLY=word of axes
	+@$(again) venv
	+@$(again) all
	@.venv/bin/python bench/stability.py $(if $(QUICK),--quick) $(if $(REDUCED),--reduced) \
	  $(if $(ONLY),--only "$(ONLY)") $(if $(FRESH),--fresh)

debug sanitize: ## build bin/bipact-debug or bin/bipact-sanitize
	+@$(again) FLAVOUR=$@ all

deps: ## install compiler and libraries, if any is missing
	@FC="$(FC)" PYTHON="$(PYTHON3)" scripts/install-deps.sh

venv: deps ## make .venv with the Python packages of requirements.txt
	@PYTHON="$(PYTHON3)" scripts/setup-venv.sh

gmsh: venv ## add Gmsh to .venv, which meshes .geo files and reads .msh files for scripts/mesh2deck.py
	@PYTHON="$(PYTHON3)" scripts/setup-gmsh.sh

install: ## build, then install below PREFIX (/usr/local), for packagers below DESTDIR/PREFIX
	+@$(again) all
	@DESTDIR="$(DESTDIR)" PREFIX="$(PREFIX)" FLAVOUR=$(FLAVOUR) scripts/install.sh

uninstall: ## remove what make install put there
	@DESTDIR="$(DESTDIR)" PREFIX="$(PREFIX)" FLAVOUR=$(FLAVOUR) scripts/install.sh --remove

clean: ## remove what was built
	rm -rf build bin

distclean: clean ## remove .venv and demonstration results too
	rm -rf .venv .venv-pydyna .venv-vtk .venv-vtk-before .venv-pandas demo.out

help: ## show this list
	@sed -n 's/^\([a-z][a-z -]*\):[^#]*## /\1: /p' $(firstword $(MAKEFILE_LIST)) \
	  | awk -F ': ' '{ printf "  %-16s %s\n", $$1, $$2 }'

# ---------------------------------------------------------------- the build itself

ifneq ($(filter-out $(light),$(or $(MAKECMDGOALS),all)),)

ifeq ($(shell command -v $(firstword $(FC)) 2>/dev/null),)
$(error $(FC) was not found: run "make deps", which installs what is missing)
endif

flags.release := -O3 $(if $(ARCH),-march=$(ARCH))
flags.debug := -O0 -g -fcheck=all,no-array-temps -finit-real=snan -ffpe-trap=invalid,zero,overflow -fbacktrace \
               -DBIPACT_DEBUG
flags.sanitize := -O1 -g -fsanitize=address,undefined -fbacktrace -DBIPACT_DEBUG
ifeq ($(flags.$(FLAVOUR)),)
$(error FLAVOUR is release, debug or sanitize, not "$(FLAVOUR)")
endif
# The two warnings left out are spurious for do-nothing base procedures and allocatable results.
flags := -std=f2008 -fimplicit-none -Wall -Wextra -Wno-unused-dummy-argument \
         -Wno-maybe-uninitialized $(flags.$(FLAVOUR)) $(FFLAGS)

# Static archives start faster and give the same binary on every machine of one kind.
archive = $(filter /%,$(shell $(FC) -print-file-name=lib$(1).a))
ifndef LIBS
LIBS := $(foreach lib,lapack blas metis,$(or $(call archive,$(lib)),-l$(lib)))
endif
ifndef LDFLAGS
LDFLAGS := $(if $(call archive,gfortran),-static-libgfortran)
endif
# An ALLOCATE that fails comes to base_memory.
LDFLAGS += -Wl,--wrap=_gfortran_os_error_at -Wl,--wrap=_gfortran_os_error

# The same for HDF5 and what it needs: shared, it takes 8 ms to start.
ifndef HDF5_LIBS
hdf5_serial := $(if $(findstring serial,$(HDF5_MODULES)),_serial)
HDF5_LIBS := $(foreach lib,hdf5$(hdf5_serial)_fortran hdf5$(hdf5_serial) sz aec z,$(call archive,$(lib)))
ifneq ($(words $(HDF5_LIBS)),5)
HDF5_LIBS := -lhdf5$(hdf5_serial)_fortran -lhdf5$(hdf5_serial)
endif
HDF5_LIBS += -ldl -lm
endif

version := $(B)/gen/base_version.f90
sources := $(wildcard src/*/*.f90 src/*/*.F90) $(version)
hdf5 := $(wildcard src/hdf5/*.f90)
fclib := $(wildcard src/fclib/*.f90)
store := $(wildcard src/store/*.f90)
mpi := $(wildcard src/mpi/*.f90)
support := $(wildcard tests/support/*.f90)
units := $(wildcard tests/unit/test_*.f90)
benches := $(wildcard bench/*.f90)
# Benches that read files of contact problems.
hdf5-benches := bench/auto_against_all.f90
examples := $(wildcard examples/*.f90)
object = $(patsubst %,$(B)/obj/%.o,$(basename $(notdir $(1))))
programs := $(patsubst tests/unit/%.f90,$(B)/tests/%,$(units))
bench-programs := $(patsubst bench/%.f90,$(B)/bench/%,$(if $(HDF5_MODULES),$(benches),$(filter-out $(hdf5-benches),$(benches))))

# Replaces the target by its new text only if it differs, so that nothing is remade needlessly.
refresh = if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

# A file that compiled with warnings leaves them in its .log: WERROR=1 compiles it once more, so
# that warnings do not slip through because the object was there already.
ifeq ($(WERROR),1)
warned := $(shell find $(B)/obj -name '*.log' -size +0 2>/dev/null)
$(shell rm -f $(warned:.log=.o))
endif

# Arrays there are of one element or point: they need no memory of the heap anew each time.
small := src/solid/% src/material/%

# Files with parallel regions, which are directives of OpenMP: built with OPENMP= they are comments.
threaded := $(addprefix src/,linalg/linalg_panels.f90 linalg/linalg_supernodal.f90 linalg/linalg_ldlt.f90 \
              assembly/assembly_threads.f90) tests/support/thread_clock.f90
OPENMP ?= -fopenmp
ifndef OPENMP_LIBS
OPENMP_LIBS := $(if $(OPENMP),$(or $(call archive,gomp),-lgomp))
endif

$(call object,$(threaded)): $(B)/openmp
$(B)/openmp: FORCE
	@mkdir -p $(@D)
	@echo '$(OPENMP)' >$@.new
	@$(refresh)

# Products of panels: -O3 of GCC shuffles the numbers of a block about, which halves the rate. The
# wide one is called where the processor has its vectors, by linalg_panels.
tiles := src/linalg/linalg_tile.f90 src/linalg/linalg_tile_wide.f90
ifeq ($(FLAVOUR),release)
tile_flags := -O2 -ftree-loop-vectorize -fno-tree-slp-vectorize -fvect-cost-model=dynamic
endif
wide_flags := $(if $(filter x86_64-%,$(shell $(FC) -dumpmachine)),-mavx2)
$(call object,$(tiles)): src/linalg/linalg_tile.inc

define compile
@mkdir -p $(@D) $(B)/mod
@echo "  FC   $<"
$(Q)$(FC) $(flags) $(if $(filter 1,$(WERROR)),-Werror) $(if $(filter $(small),$<),-fstack-arrays) \
  $(if $(filter $(tiles),$<),$(tile_flags)) $(if $(filter %_wide.f90,$<),$(wide_flags)) \
  $(if $(filter $(threaded),$<),$(OPENMP)) \
  $(if $(filter src/hdf5/% src/fclib/% src/store/% src/mpi/%,$<),-I$(HDF5_MODULES)) \
  $(if $(filter src/mpi/%,$<),$(MPI_FLAGS) -I$(MUMPS_INCLUDE)) -J$(B)/mod -c $< -o $@ \
  2>$(@:.o=.log) || { cat $(@:.o=.log) >&2; exit 1; }; cat $(@:.o=.log) >&2
endef

define link
@mkdir -p $(@D)
@echo "  LINK $@"
$(Q)$(FC) $(flags) $(LDFLAGS) -o $@ $(filter %.o %.a,$^) $(LIBS) $(OPENMP_LIBS) \
  || { echo 'Linking failed. If a library was not found: run "make deps".' >&2; exit 1; }
endef

$(BIN): $(B)/obj/main.o $(LIB) $(B)/flags
	$(link)

$(FCLIB_BIN): $(call object,$(fclib) $(hdf5)) $(LIB) $(B)/flags
$(STORE_BIN): $(call object,$(store) $(hdf5)) $(LIB) $(B)/flags
$(FCLIB_BIN) $(STORE_BIN):
	@mkdir -p $(@D)
	@echo "  LINK $@"
	$(Q)$(FC) $(flags) $(LDFLAGS) -o $@ $(filter %.o %.a,$^) $(LIBS) $(OPENMP_LIBS) $(HDF5_LIBS) \
	  || { echo 'Linking failed. If HDF5 was not found: run "make deps".' >&2; exit 1; }

# The libraries of MPI and MUMPS are shared, and so is that of Fortran then. Our own calls go to
# the archives of LAPACK and BLAS as those of the serial program do, whatever MUMPS is given.
own-lapack := $(foreach lib,lapack blas,$(call archive,$(lib)))
own-lapack := $(if $(own-lapack),-Wl$(comma)--exclude-libs$(comma)liblapack.a:libblas.a $(own-lapack))
$(MPI_BIN): $(call object,$(mpi) $(filter-out %_main.f90,$(store)) $(hdf5)) $(LIB) $(B)/flags
	@mkdir -p $(@D)
	@echo "  LINK $@"
	$(Q)$(FC) $(flags) $(filter-out -static-libgfortran,$(LDFLAGS)) -o $@ $(filter %.o %.a,$^) $(HDF5_LIBS) $(own-lapack) $(MPI_LIBS) $(OPENMP_LIBS) \
	  || { echo 'Linking failed. If MPI or MUMPS was not found: run "make deps".' >&2; exit 1; }

test-programs: $(programs)

bench-programs: $(bench-programs)

# linear_solvers puts a clock around parallel regions.
$(B)/bench/linear_solvers: private LDFLAGS += $(foreach name,parallel loop_nonmonotonic_dynamic_start \
  loop_nonmonotonic_dynamic_next,-Wl,--wrap=GOMP_$(name))
$(patsubst bench/%.f90,$(B)/bench/%,$(hdf5-benches)): LIBS += $(HDF5_LIBS)
$(patsubst bench/%.f90,$(B)/bench/%,$(hdf5-benches)): \
  $(call object,$(filter-out src/fclib/fclib_main.f90,$(fclib)) $(hdf5))
$(bench-programs): $(B)/bench/%: $(B)/obj/%.o $(SUPPORT) $(LIB) $(B)/flags
	$(link)

example-programs: $(example-programs)

$(example-programs): $(B)/examples/%: $(B)/obj/%.o $(LIB) $(B)/flags
	$(link)

# test_allocations puts itself between the program and the library of C.
$(B)/tests/test_allocations: private LDFLAGS += -Wl,--wrap=malloc -Wl,--wrap=realloc
$(programs): $(B)/tests/%: $(B)/obj/%.o $(SUPPORT) $(LIB) $(B)/flags
	$(link)

# An archive: a program takes what it uses.
$(SUPPORT): $(call object,$(support)) $(B)/deps.mk
	$(Q)rm -f $@
	$(Q)ar rcs $@ $(filter %.o,$^)

# Made anew, also when only the list of sources (in deps.mk) changed: no stale member stays in it.
$(LIB): $(call object,$(filter-out src/run/main.f90 $(hdf5) $(fclib) $(store) $(mpi),$(sources))) $(B)/deps.mk
	$(Q)rm -f $@
	$(Q)ar rcs $@ $(filter %.o,$^)

$(version): VERSION
	@mkdir -p $(@D)
	@printf "%s\n" '!> Written by the Makefile from the file VERSION.' 'module base_version' \
	  'implicit none' 'private' \
	  "character(*), parameter, public :: version = '$$(head -n 1 VERSION)'" \
	  'end module base_version' >$@

# Other flags or another compiler: everything is compiled again.
$(B)/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(FC) $(shell $(FC) -dumpfullversion) $(flags) $(LDFLAGS) $(LIBS)' >$@.new
	@$(refresh)

# Scanned each time (milliseconds): only so a removed or renamed source is noticed.
$(B)/deps.mk: $(version) FORCE
	@awk -f scripts/mkdeps.awk $(sources) $(support) $(units) $(benches) $(examples) >$@.new
	@$(refresh)

include $(B)/deps.mk

endif
