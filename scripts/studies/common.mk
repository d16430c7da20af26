# What the studies share. A study's Makefile sets the names below, includes this file, and adds its recipes.
#
#   documents   what goes into the page, in its order, without the folder
#   pictures    what text.md shows
#   ours        recipes of numbers: each of the $(ours) files holds "name<TAB>value" lines
#
# make: documents, pictures and numbers; make report: the page. Everything is written to $(out).
here := $(dir $(abspath $(firstword $(MAKEFILE_LIST))))
include $(dir $(abspath $(lastword $(MAKEFILE_LIST))))where.mk
study := $(notdir $(patsubst %/,%,$(here)))
scripts := $(root)/scripts
data := $(root)/testdata
out := $(OUT)/$(study)
# The built tools, else those in PATH.
TOOLS ?= $(root)/build/bin
export PATH := $(if $(wildcard $(TOOLS)/sdm-lobes),$(TOOLS):)$(PATH)

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.SUFFIXES:
# Intermediate documents stay: they are results.
.SECONDARY:

.PHONY: all report clean
all: $(addprefix $(out)/,$(documents) $(pictures) $(tables) $(if $(ours),beside.md))

report: $(out)/report.html
	@echo "$(out)/report.html"

clean:
	rm -rf $(out)

$(out):
	mkdir -p $@

# The paper's numbers beside ours: fails where a number that can agree does not.
ifneq ($(ours),)
$(out)/beside.md: $(here)paper.tsv $(addprefix $(out)/,$(ours)) $(studies)beside
	$(studies)beside $(here)paper.tsv $(addprefix $(out)/,$(ours)) > $@
endif

# A line "@include NAME" of text.md stands for the file NAME in the study's output.
$(out)/text.md: $(here)text.md $(addprefix $(out)/,$(pictures) $(tables) $(if $(ours),beside.md))
	awk -v out=$(out) '/^@include / { while ((getline line < (out "/" $$2)) > 0) print line; next } { print }' $< > $@

$(out)/report.html: $(out)/text.md $(addprefix $(out)/,$(documents)) $(scripts)/report $(wildcard $(scripts)/reporting/*)
	$(scripts)/report --title "$(title)" --text $(out)/text.md $(addprefix $(out)/,$(documents)) -o $@
