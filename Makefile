# `make` renders the lab's box with the newest stage; `make help` lists the
# other targets.

# Against injection: what users type goes to programs through the environment,
# unexpanded, and recipes use it as a quoted shell variable.
typed := A B SCENE OPTIONS MISTAKES MUTANTS BASE SEEDS HARNESS STAGE OUT INTO \
  SOLUTIONS ORDERS FRESH SECONDS LIMIT FROM ROSTER HIDDEN HIDE ONLY READ ENGINE BUILD
$(foreach name,$(typed),$(eval override $(name) := $$(value $(name))))
export $(filter-out BUILD,$(typed))

override BUILD := $(or $(BUILD),build)
# Rules and recipes contain it.
ifneq ($(words $(BUILD))$(strip $(foreach sign,; & | < > ( ) ` " ' $$ \,$(findstring $(sign),$(BUILD)))),1)
  $(error BUILD='$(BUILD)': a folder name without blanks and shell characters is expected)
endif

# Set CMAKE_ARGS to pass more to CMake, such as -DCMAKE_CXX_COMPILER=clang++.
CMAKE_ARGS ?=
JOBS   ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)

stages := $(sort $(foreach main,$(wildcard stages/[1-9]_*/main.cpp),\
            stage$(firstword $(subst _, ,$(notdir $(patsubst %/,%,$(dir $(main))))))))
newest := $(lastword $(stages))
# The lab's box, as the newest stage can render it.
scene_stage1 := scenes/cornell_box_ceiling_diffuse.toml
scene_stage2 := scenes/cornell_box_point_diffuse.toml
scene  := $(or $(scene_$(newest)),scenes/cornell_box_point.toml)

.PHONY: picture help setup build test bench bench-peers measured mistakes goldens \
  mutants diff null-test bench-compare fuzz \
  format clean check watch hint handout handouts test-fresh single-header \
  test-single-header test-windows class test-class $(stages) $(addprefix test-,$(stages))
include tools/site.mk

# Where the Python programs look for what was built.
export LIGHTWALK_BUILD := $(abspath $(BUILD))

.DEFAULT_GOAL := picture

picture: build
	@mkdir -p $(BUILD)/pictures
	@$(BUILD)/$(newest) $(scene) -o $(BUILD)/pictures/cornell_box.png
	@echo "The picture is $(CURDIR)/$(BUILD)/pictures/cornell_box.png"
	@sed -n 's/^programs: /Left out: /p' $(BUILD)/left_out.txt

define help_text
For the course
  make               render the lab's box with $(newest), the newest stage
  make $(firstword $(stages))        build one stage ($(stages))
  make test-$(firstword $(stages))   run the tests of one stage
  make check         check each exercise, and explain the first open one (STAGE=2)
  make watch         the same at every save
  make hint          a hint for the exercise that make check explains
  make single-header each stage in one file: $(BUILD)/single/stageN.hpp

To teach
  make handout STAGE=3 OUT=folder    a handout for students: stage 3 open, nothing later
                     (SOLUTIONS=none opens the earlier stages, too)
  make handout STAGE=4 INTO=folder   the next stage, into a student's folder
  make handouts      test all handouts, from open to solved
  make class FROM=folder STAGE=3     grade the submissions in a folder, in a sandbox:
                     a page with pictures, points.csv; OUT=folder, ROSTER=file.csv,
                     HIDDEN=folder (scenes of your own), HIDE=1 (a page without
                     names), ONLY=name (one again, explained), ENGINE=slurm
  make diff A=stage3 B=stage4 SCENE=scenes/plastic.toml
                     render and compare two stages, images or programs
  make book          weave the book: $(BUILD)/book/index.html; make book-pdf prints it
  make slides        set the slides: $(BUILD)/slides/index.html

To work on it
  make test          run all tests but the site's
  make test-site     test the book and the slides, in a browser too
  make test-class    test the grading of a class, and a Slurm of one node
  make test-single-header, make test-windows, make test-fresh
                     with other compilers, under wine, on new Debian systems
  make mistakes      put known mistakes into the stages: what do the tests catch?
  make mutants       make every small change to the stages: what do the tests catch?
  make null-test     how often do the goldens reject a right program?
  make fuzz          feed random input to the file readers (SECONDS=60)
  make goldens       remake the golden images
  make bench         measure the time of everything (BASE=old.json compares)
  make bench-peers   time stages 5 and 6 and Mitsuba 3 side by side
  make measured      store the measurements, for the book
  make format        format the code (CHECK=1 only reports)
  make setup         install what is missing (SETUP=print only prints it)
  make clean         delete $(BUILD)/

BUILD=folder builds elsewhere, CMAKE_ARGS="-DCMAKE_CXX_COMPILER=clang++" is
passed to CMake, JOBS=1 compiles one file at a time.
endef
export help_text
help:
	@echo "$$help_text"

# Takes milliseconds if nothing is missing. SETUP=print exits with 1 if something
# is: ignored if setup is the only goal.
printed := $(if $(MAKECMDGOALS),$(if $(filter-out setup setup-%,$(MAKECMDGOALS)),,|| [ "$$SETUP" = print ]))
setup:
	@tools/setup.sh $(printed)

# What other targets need in addition.
setups := $(addprefix setup-,site slides class slurm fuzz bench peers windows compilers fresh all)
.PHONY: $(setups)
$(setups): setup-%: setup
	@tools/setup.sh $* $(printed)

# The first configuration; CMake itself notices later changes.
$(BUILD)/CMakeCache.txt: | setup
	@cmake -S . -B $(BUILD) $(if $(shell command -v ninja),-G Ninja) \
	  -DCMAKE_BUILD_TYPE=Release $(CMAKE_ARGS) > $(BUILD).log 2>&1 \
	  || { cat $(BUILD).log; rm -f $@ $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log

# $(compile) TARGETS: silent if there is nothing to do.
compile = tools/compile.sh $(BUILD) -j $(JOBS) --target

build: setup $(BUILD)/CMakeCache.txt
	@$(compile) $(stages)

$(stages): setup $(BUILD)/CMakeCache.txt
	@$(compile) $@

stage%:
	@echo "make: there is no $@; there are $(stages)" >&2; exit 2

test: setup $(BUILD)/CMakeCache.txt
	@$(compile) all
	@python3 -m tests.run -j $(JOBS)

# The header by itself first, so that the compiler reports its errors once.
$(addprefix test-,$(stages)): test-%: setup $(BUILD)/CMakeCache.txt
	@$(compile) $*_header
	@$(compile) $*_tests
	@python3 -B -m tests.runner $(BUILD)/$*_tests

# Checks the exercises of a stage, in the chapter's order, and explains the first
# that is not done. The default of STAGE is the newest stage.
check watch hint: setup $(BUILD)/CMakeCache.txt
	@set -f; python3 -m tools.exercises.check $$STAGE $(if $(filter-out check,$@),--$@)

# STAGE=3 OUT=folder, or STAGE=4 INTO=folder. SOLUTIONS=none opens the
# exercises of the earlier stages, too.
handout: setup
	@python3 -m tools.handout.handout "$$STAGE" $(if $(OUT),--out "$$OUT") \
	  $(if $(INTO),--into "$$INTO") $(if $(SOLUTIONS),--solutions "$$SOLUTIONS")

# Five to ten minutes; ORDERS=1 inserts the solutions in the chapter's order only.
handouts: setup
	@python3 -m tools.handout.prove --orders "$${ORDERS:-2}"

# Grades the submissions in FROM, each in a sandbox.
class: setup-class $(BUILD)/CMakeCache.txt
	@[ -n "$$FROM" ] && [ -n "$$STAGE" ] || { \
	  echo "class: FROM=folder and STAGE=number are required" >&2; exit 2; }
	@python3 -B -m tools.grading "$$FROM" "$$STAGE" --jobs $(JOBS) \
	  $${OUT:+--out "$$OUT"} $${ROSTER:+--roster "$$ROSTER"} \
	  $${HIDDEN:+--hidden "$$HIDDEN"} $${HIDE:+--hide-names} \
	  $${ONLY:+--only "$$ONLY"} $${READ:+--read} $${ENGINE:+--engine "$$ENGINE"}

test-class: setup-class setup-slurm $(BUILD)/CMakeCache.txt
	@$(compile) stage1 stage1_tests stage-diff
	@python3 -B -m tests.scripts tools/grading/test_grading.py

# make diff A=stage3 B=stage4 SCENE=scenes/plastic.toml OPTIONS="--spp 64": A and
# B may be stages, images, or programs. Exit code 1 if they differ.
diff: build
	@$(compile) stage-diff
	@BUILD=$(BUILD) compare/diff.sh

# Each stage with its core in one header that needs only GLM.
single-header:
	@python3 -m tools.handout.single_header

# Compiles each with each installed compiler, and compares its picture with the
# tree's: minutes. `make test` does only the newest stage.
test-single-header: setup-compilers build
	@LIGHTWALK_EVERY_STAGE=1 python3 -B -m tests.scripts \
	  tests/command_line/test_single_header.py -k EveryStage

# Remakes the golden images: minutes.
goldens: build
	@python3 -m tests.golden.make_goldens

# How often the goldens reject a right program: minutes.
null-test: build
	@$(compile) null_test
	@$(BUILD)/null_test "$${SEEDS:-200}"

# Takes minutes at first; later runs repeat only what has changed. MISTAKES is a
# list of mistakes, or options of the program: MISTAKES="--stage 2".
mistakes: setup $(BUILD)/CMakeCache.txt
	@$(compile) all
	@set -f; python3 -m tests.mistakes.mistakes -j $(JOBS) $$MISTAKES

# Feeds random input to the file readers and the geometry, for SECONDS in all;
# HARNESS names some of tests/fuzz/. Built by Clang, in its own folder;
# FUZZ_CXX names another compiler.
fuzz_cxx = $(or $(FUZZ_CXX),$(firstword $(wildcard $(addsuffix \
  /opt/llvm/bin/clang++,/opt/homebrew /usr/local)) clang++))

$(BUILD)/fuzz/CMakeCache.txt: | setup-fuzz
	@mkdir -p $(@D)
	@cmake -S . -B $(@D) $(if $(shell command -v ninja),-G Ninja) \
	  -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=$(fuzz_cxx) \
	  -DLIGHTWALK_SANITIZE=address,undefined -DLIGHTWALK_TESTS=OFF \
	  -DLIGHTWALK_FUZZ=ON $(CMAKE_ARGS) > $(@D)/configure.log 2>&1 \
	  || { cat $(@D)/configure.log; rm -f $@; exit 1; }

fuzz: export FUZZ_SECONDS = $(SECONDS)# a shell may count its own SECONDS
fuzz: setup-fuzz $(BUILD)/fuzz/CMakeCache.txt
	@cmake --build $(BUILD)/fuzz -j $(JOBS) --target harnesses > $(BUILD)/fuzz/build.log 2>&1 \
	  || { cat $(BUILD)/fuzz/build.log; exit 1; }
	@set -f; python3 -m tests.fuzz.fuzz -j $(JOBS) --seconds "$${FUZZ_SECONDS:-60}" $$HARNESS

# Compiles programs for Windows with this machine's registers, and tests them
# under wine: minutes.
test-windows: setup-windows build windows-tools
	@$(compile) stage-diff
	@cmake -S . -B $(BUILD)/windows -DLIGHTWALK_NATIVE=ON \
	  $(if $(shell command -v ninja),-G Ninja) -DCMAKE_BUILD_TYPE=Release \
	  -DCMAKE_TOOLCHAIN_FILE=$(CURDIR)/cmake/mingw-w64.cmake > $(BUILD)/windows.log 2>&1 \
	  || { cat $(BUILD)/windows.log; exit 1; }
	@tools/compile.sh $(BUILD)/windows -j $(JOBS) \
	  --target $(stages) stage-diff core_tests $(addsuffix _tests,$(stages))
	@python3 -m tests.windows.test_windows

.PHONY: windows-tools
windows-tools: setup-windows build
	@python3 -m tests.windows.tools

# Runs the README's commands on new Debian systems, made by debootstrap: an hour,
# as root. FRESH names releases: FRESH=trixie.
test-fresh: setup-fresh
	@set -f; python3 -m tests.fresh $$FRESH

# Half an hour at first; later runs are faster. MUTANTS has options of the
# program: MUTANTS="--stage 2".
mutants: setup $(BUILD)/CMakeCache.txt $(BUILD)/mutants-venv/made
	@$(compile) test_support test_main image_module $(addsuffix _tests,$(stages))
	@set -f; $(BUILD)/mutants-venv/bin/python -m tests.mutants.mutants -j $(JOBS) $$MUTANTS

# With repetitions, since times vary. BASE names an earlier bench.json, which
# Google Benchmark's compare.py compares with this one.
BENCH_ARGS ?= --benchmark_repetitions=5 --benchmark_min_time=0.05
bench: build
	@$(compile) benchmarks
	@$(BUILD)/benchmarks $(BENCH_ARGS) --benchmark_out_format=json \
	  --benchmark_out=$(BUILD)/bench.json \
	  --benchmark_display_aggregates_only=true
	@$(if $(BASE),$(MAKE) --no-print-directory bench-compare)
	@python3 -m tools.bench.efficiency --chart $(BUILD)/convergence.svg \
	  > $(BUILD)/efficiency.md
	@cat $(BUILD)/efficiency.md
	@python3 -m tools.bench.bar

# Packages from PyPI, in a virtual environment for each purpose, with versions
# and hashes: tools/setup/lock.sh writes them.
$(BUILD)/%-venv/made: tools/setup/%.txt | setup
	@rm -rf $(@D)
	@python3 -m venv $(@D)
	@$(@D)/bin/python -m pip install --quiet --require-hashes -r $<
	@touch $@

compare_py = $(firstword $(wildcard $(addsuffix /compare.py, \
  /usr/share/benchmark $(addsuffix /share/googlebenchmark/tools, \
  /opt/homebrew /usr/local))))
bench-compare: setup-bench $(BUILD)/bench-venv/made
	@$(BUILD)/bench-venv/bin/python $(or $(compare_py),$(error \
	  Google Benchmark came without its compare.py)) --no-color \
	  -a benchmarks "$$BASE" $(BUILD)/bench.json

# Mitsuba 3 side by side with stages 5 and 6; ALSO names another build folder,
# for other registers:
#   make BUILD=build-avx2 CMAKE_ARGS="-DLIGHTWALK_NATIVE=OFF \
#     -DCMAKE_CXX_FLAGS='-march=x86-64-v3 -maes -mpclmul'"
bench-peers: build setup-peers $(BUILD)/bench-venv/made
	@$(BUILD)/bench-venv/bin/python -m tools.bench.peers $(addprefix --also ,$(ALSO)) | tee $(BUILD)/peers.md

# Stores the results of `make bench` and `make bench-peers`, with the machine and
# the date, in the folder that the book and the README quote.
measured: $(BUILD)/bench.json $(BUILD)/peers.md
	@python3 -m tools.bench.measured
$(BUILD)/bench.json:
	@$(MAKE) --no-print-directory bench
$(BUILD)/peers.md:
	@$(MAKE) --no-print-directory bench-peers

# CHECK=1 only reports what is not formatted.
format: $(BUILD)/format-venv/made
	@git ls-files '*.hpp' '*.cpp' | xargs $(BUILD)/format-venv/bin/clang-format \
	  $(if $(CHECK),--dry-run --Werror,-i)
	@$(BUILD)/format-venv/bin/ruff format --quiet --no-cache $(if $(CHECK),--diff) .

clean:
	@cmake -E rm -rf $(BUILD)
