# The front door. `make` renders the lab's box with the newest stage;
# `make help` lists what else there is.

BUILD  ?= build
# Set CMAKE_ARGS to pass more to CMake, such as -DCMAKE_CXX_COMPILER=clang++.
CMAKE_ARGS ?=
JOBS   ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)

stages := $(sort $(foreach main,$(wildcard stages/[1-9]_*/main.cpp),\
            stage$(firstword $(subst _, ,$(notdir $(patsubst %/,%,$(dir $(main))))))))
newest := $(lastword $(stages))
# The lab's box as far as the newest stage can render it.
scene_stage1 := scenes/cornell_box_ceiling_diffuse.toml
scene_stage2 := scenes/cornell_box_point_diffuse.toml
scene  := $(or $(scene_$(newest)),scenes/cornell_box_point.toml)

include tools/site.mk

.PHONY: picture help setup build test clean $(stages) $(addprefix test-,$(stages))
.DEFAULT_GOAL := picture

picture: build
	@mkdir -p $(BUILD)/pictures
	@$(BUILD)/$(newest) $(scene) -o $(BUILD)/pictures/cornell_box.png
	@echo "The picture is $(CURDIR)/$(BUILD)/pictures/cornell_box.png"

help:
	@echo "make               render the lab's box with $(newest), the newest stage"
	@echo "make test          run every test"
	@echo "make $(firstword $(stages))        build one stage alone ($(stages))"
	@echo "make test-$(firstword $(stages))   run the tests of one stage"
	@echo "make book          weave the book: $(BUILD)/book/index.html"
	@echo "make setup         install what is missing (SETUP=print only says what)"
	@echo "make clean         delete $(BUILD)/"
	@echo "make help          this list"

# Costs milliseconds where nothing is missing.
setup:
	@tools/setup.sh

# What CMake has configured; CMake itself sees to later changes.
$(BUILD)/CMakeCache.txt: | setup
	@cmake -S . -B $(BUILD) $(if $(shell command -v ninja),-G Ninja) \
	  -DCMAKE_BUILD_TYPE=Release $(CMAKE_ARGS) > $(BUILD).log 2>&1 \
	  || { cat $(BUILD).log; rm -f $@ $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log

build: setup $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS) --target $(stages)

$(stages): setup $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS) --target $@

test: setup $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS)
	@ctest --test-dir $(BUILD) --no-tests=error --output-on-failure -j $(JOBS)

$(addprefix test-,$(stages)): test-%: setup $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS) --target $* $*_tests
	@ctest --test-dir $(BUILD) --no-tests=error --output-on-failure -j $(JOBS) \
	  -L '^$*$$'

clean:
	@cmake -E rm -rf $(BUILD)
