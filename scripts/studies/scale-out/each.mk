# A target for each task in $(out)/todo.tsv.
ids := $(shell cut -f 1 $(out)/todo.tsv)
.PHONY: all $(ids)
all: $(ids)
$(ids):
	@awk -v id=$@ '$$1 == id' $(out)/todo.tsv | $(here)run-tasks $(out)
