# The commands of daily life. Set-up is in scripts/setup.sh, C++ in CMakePresets.json.
.PHONY: help demo test lint format bench docs gallery clean
.DEFAULT_GOAL := help
export PATH := $(CURDIR)/.venv/bin:$(PATH)

help:  ## say what there is
	@grep -hE '^[a-z]+:.*##' Makefile | sed -E 's/^([a-z]+):.*## */\1\t/' | expand -t 10

demo:  ## set up, simulate and render a dam break; say where the video is
	@scripts/setup.sh demo
	@$(MAKE) --no-print-directory out/dam_break.mp4
	@echo "The video: $(CURDIR)/out/dam_break.mp4   (the run: out/dam_break/)"

out/dam_break.mp4: scenes/dam_break.toml .venv/stamps/package
	pbfluids run $< --out out/dam_break --video $@ --size 1280x720

test:  ## set up, then every test: C++, OpenGL, Python, the installed package, the README
	@scripts/setup.sh test
	cmake --workflow --preset release
	python -m pytest

lint:  ## format, types, layers, spelling, clang-tidy
	@scripts/setup.sh lint
	scripts/lint.sh

format:  ## write the format that lint asks for
	@scripts/setup.sh lint
	scripts/lint.sh --fix

bench:  ## time the step and its stages, and say how near they are to what the machine can do
	@scripts/setup.sh bench
	cmake --workflow --preset bench
	@mkdir -p out/bench
	@failed=0; for bench in build/bench/bench/bench_*; do \
	  OMP_WAIT_POLICY=passive $$bench --benchmark_out=out/bench/$${bench##*/bench_}.json \
	    $(options) || failed=1; \
	done; exit $$failed

docs:  ## write the generated pages and type stubs again
	@scripts/setup.sh docs
	python scripts/update_docs.py
	python scripts/update_stubs.py

gallery:  ## simulate and draw the pictures of docs/gallery.md
	@scripts/setup.sh demo
	python examples/gallery.py

clean:  ## remove what was built, simulated and installed here
	rm -rf build out .venv
