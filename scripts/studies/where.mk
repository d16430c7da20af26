# Where results go: out/studies of a checkout; where the studies are installed, out/studies in the folder that make was called from.
studies := $(dir $(abspath $(lastword $(MAKEFILE_LIST))))
root := $(abspath $(studies)/../..)
OUT ?= $(if $(wildcard $(root)/CMakeLists.txt),$(root),$(PWD))/out/studies
override OUT := $(abspath $(OUT))
export OUT
