# One command per task; `make help` lists them. Needed beforehand: python3 (3.11 or newer), make and
# git. Everything else is installed into .venv, in the versions that constraints.txt names. With several
# Pythons, name one: make PYTHON=python3.12 test

PYTHON ?= python3
WORKERS ?= 2
MARKS ?= not slow

# Windows has the programs of an environment in another folder.
PROGRAMS := $(if $(filter Windows_NT,$(OS)),Scripts,bin)
BIN := .venv/$(PROGRAMS)
BARE := .venv/.bare
STAMP := .venv/.installed
FLOOR := build/floor
FLOOR_STAMP := $(FLOOR)/.installed
WHEEL := build/wheel
BILL := build/bill
VERSION = $(shell sed -n 's/^__version__ = "\(.*\)"/\1/p' src/rocksteady/__init__.py)
# What the tests of the package import; those of pages, pictures and tools need the checkout's environment.
WHEEL_NEEDS := hypothesis mpmath numba psutil pytest pytest-xdist python-flint statsmodels
WHEEL_TESTS := $(addprefix tests/,dynamics kernels model records results risk seismic sweep)
EXTRAS := bench,build,cluster,dev,docs,gpu,records,stores
PEERS := heyoka mujoco
# What tests-floor runs: where each dependency of the package and of its extras cluster, proof and records is
# called. Left out are the kernels in their library and most of dynamics, which call NumPy alone, studies and
# commands, which call what is run here, and tests of pages, tools and the manual. The examples of all docstrings
# are in tests/public.
FLOOR_TESTS := $(addprefix tests/,certify cli/console cli/flags cli/test_app.py dynamics/basins \
	dynamics/continuation/chains facades/checks kernels/machine_code model public records results risk/assess/described \
	risk/back_analysis risk/calibration risk/ensemble risk/fits risk/fragility risk/free_rocking \
	risk/hazard risk/observations risk/screens seismic show/export show/figures show/film show/plots show/style sweep words)
CHECKS := lint types layers library tests
# What mutants runs: the tests in the folder of each module, or TESTS=.
TESTS ?= $(sort $(foreach path,$(PATHS:src/rocksteady/%=%),tests/$(if $(filter %.py,$(path)),$(dir $(path)),$(path))))
# What make test leaves to make test-all, with what its end says of each.
BEYOND := docs tests-python tests-floor frozen-all
LEFT := the slow tests, the manual, kernels as plain Python, lower bounds, all recorded answers
# A check writes here what it could not run, and the end prints it.
NOT_RUN := build/not-run

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules

# The same result from any shell: what another environment, a user's pip settings or a debugging
# session has exported must reach neither the installation nor the checks.
unexport VIRTUAL_ENV CONDA_PREFIX PYTHONHOME PYTHONPATH PYTHONSTARTUP PYTHONWARNINGS PYTHONOPTIMIZE
unexport PYTHONDONTWRITEBYTECODE
unexport PIP_TARGET PIP_PREFIX PIP_ROOT PIP_CONSTRAINT PIP_REQUIREMENT PIP_NO_DEPS PIP_DRY_RUN
unexport UV_CONSTRAINT UV_BUILD_CONSTRAINT UV_OVERRIDE UV_PYTHON UV_SYSTEM_PYTHON UV_NO_BUILD_ISOLATION
unexport MYPYPATH NUMBA_DISABLE_JIT ROCKSTEADY_KERNELS ROCKSTEADY_BUILD
export PIP_USER := 0
export PIP_NO_INPUT := 1
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PYTHONNOUSERSITE := 1
export PYTHONUTF8 := 1
export MPLBACKEND := Agg

##@ Start here

.PHONY: help
help: ## list the commands [nothing]
	@awk 'BEGIN { FS = ":.*## " } \
		/^##@ / { printf "\n%s\n", substr($$0, 5) } \
		/^[.a-z-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)
	@printf '\nWhat each installs first, unless it is there: [package], which is rocksteady, its kernels compiled; [nothing];\n'
	@printf 'all others also what checks, manual, benchmarks and wheels need, and what stands behind +.\n'

.PHONY: demo
demo: $(BARE) ## film a block that falls, write the explorer, do a whole paper again: out/ [package]
	@mkdir -p out
	$(BIN)/rocksteady simulate --block tso-wong-1989 -A 2 -W 1.7 --start steady --cycles 40 \
		--plot out/simulate.png --animate out/simulate.gif --force
	$(BIN)/rocksteady explore --out out/explorer.html --force --no-browser
	$(BIN)/rocksteady paper --out out/tso-wong-1989 --force
	@printf '\n%s\n' "Made, to look at:" "  out/simulate.gif               a block that falls" \
		"  out/explorer.html              the explorer: push the ground yourself, offline" \
		"  out/tso-wong-1989/report.html  the paper of 1989, every figure and statement" \
		"next: $(PYTHON) -m webbrowser -t out/explorer.html"

.PHONY: explore
explore: $(BARE) ## write the explorer, a page to touch, and open it in the browser [package]
	@mkdir -p out
	$(BIN)/rocksteady explore --out out/explorer.html --force

.PHONY: test
test: ## run every check that takes seconds, and the tests but the slow ones: some five minutes
	@echo "make test: about 5 minutes on two cores$(if $(wildcard $(STAMP)),, and 1 to 2 more this first time to install and compile)"
	@$(MAKE) --no-print-directory .venv
	@$(call ahead,library) $(call run-in-turn,$(CHECKS),$(MAKE),exit 1;)

.PHONY: test-all
test-all: ## run every check to its end, the slow tests and the lower bounds included: forty minutes
	@$(MAKE) --no-print-directory .venv
	@$(call ahead,library) $(call run-in-turn,$(CHECKS) $(BEYOND),$(MAKE) MARKS=)

##@ One check at a time

.PHONY: lint
lint: .venv ## ruff: rules and format; deptry: what is imported is declared
	$(BIN)/python -m ruff check
	$(BIN)/python -m ruff format --check
	@said=$$($(BIN)/deptry --no-ansi src 2>&1) || { echo "$$said" >&2; exit 1; }

.PHONY: count
count: ## code lines by package, of tests, tools, benchmarks and JavaScript, and what has grown large [nothing]
	@$(PYTHON) -m tools.count

.PHONY: types
types: .venv ## mypy --strict over src and tests, and tsc over the page where tsc or bun is
	$(BIN)/python -m mypy --num-workers $(WORKERS)
	@$(BIN)/python -m tools.page

.PHONY: layers
layers: .venv ## import-linter: who may import whom
	@said=$$($(BIN)/lint-imports --no-logo 2>&1) && echo "$$said" | tail -n 1 || { echo "$$said" >&2; exit 1; }

.PHONY: tests
tests: .venv library $(if $(filter not,$(MARKS)),,gpu) ## pytest, kernels from the library (MARKS= runs the slow ones too)
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal -m "$(MARKS)"

.PHONY: tests-python
tests-python: .venv ## the kernels' tests once more as plain Python
	ROCKSTEADY_KERNELS=python $(BIN)/python -m pytest tests/kernels -n $(WORKERS) --dist worksteal

.PHONY: docs
docs: .venv library ## build the manual into out/manual; its tutorials and gallery are computed
	@# Sphinx leaves the pages of what is gone: what it writes is written anew.
	@rm -rf out/manual && mkdir -p out
	env -u MPLBACKEND $(BIN)/python -m sphinx --jobs $(WORKERS) --fail-on-warning --keep-going --quiet \
		--doctree-dir build/manual/doctrees docs out/manual

.PHONY: tests-floor
tests-floor: $(FLOOR_STAMP) library ## tests that call dependencies, each at its lower bound, the slow tests excepted [+ build/floor]
	@# Answers are recorded with the versions of constraints.txt, whose words some of them hold.
	$(FLOOR)/$(PROGRAMS)/python -m pytest -n $(WORKERS) --dist worksteal -o cache_dir=$(FLOOR)/pytest \
		--ignore tests/public/test_recorded.py $(FLOOR_TESTS)

##@ Upkeep

.PHONY: library
library: .venv ## compile the kernels into a library for this machine, unless that is done
	@$(BIN)/python -m tools.aot host

.PHONY: gpu
gpu: .venv ## compile the kernels for GPUs, for the executor "gpu"
	@$(BIN)/python -m tools.aot.device

.PHONY: .venv
.venv: $(STAMP) ## create the environment and install the package; again only where pins changed

.PHONY: install
install: .venv ## the same

.PHONY: format
format: .venv ## let ruff mend and format what it can
	$(BIN)/python -m ruff check --fix
	$(BIN)/python -m ruff format

.PHONY: freeze
freeze: .venv library ## record answers of the package in tests/frozen: those that frozen compares
	$(BIN)/python -m tools.freeze record

.PHONY: freeze-all
freeze-all: .venv library ## the same, and the large set
	$(BIN)/python -m tools.freeze record --all

.PHONY: frozen
frozen: .venv library ## compare the answers with their records: two minutes
	$(BIN)/python -m tools.freeze compare

.PHONY: frozen-all
frozen-all: .venv library ## the same, and the large set: seven minutes
	$(BIN)/python -m tools.freeze compare --all

.PHONY: bench
bench: .venv library ## time the package; writes docs/benchmarks.md
	@mkdir -p out docs
	$(BIN)/python -m pytest bench --benchmark-only --benchmark-json=out/bench.json
	$(BIN)/python bench/report.py

.PHONY: bench-peers
bench-peers: .venv library ## time other solvers beside the package; writes their part of docs/benchmarks.md [+ heyoka, mujoco]
	@mkdir -p out docs
	@# One by one: where a solver cannot be installed, its row says so.
	@for peer in $(PEERS); do \
		$(BIN)/python -m pip install --quiet --constraint constraints.txt --constraint bench/peers/constraints.txt "$$peer" || \
			echo "$$peer cannot be installed here, and its row will say so" >&2; \
	done
	$(BIN)/python -m bench.peers

.PHONY: bench-explorer
bench-explorer: .venv library ## time the explorer's page; writes its part of docs/benchmarks.md
	@mkdir -p out docs
	$(BIN)/python -m bench.explorer

.PHONY: wheels
wheels: .venv ## build a wheel for each platform and one for GPUs into dist/, and check that of this machine
	@rm -rf build/libraries
	@rm -f dist/rocksteady*.whl
	$(BIN)/python -m tools.aot build --out build/libraries
	$(BIN)/python -m tools.aot.web.program build/libraries
	$(BIN)/python -m tools.aot.device --out build/libraries --architectures sm_80
	$(BIN)/python -m tools.wheels build --libraries build/libraries --out dist
	$(BIN)/python -m tools.wheels check --wheels dist

.PHONY: sdist
sdist: .venv ## build the source distribution into dist/
	@rm -f dist/rocksteady*.tar.gz
	$(BIN)/python -m tools.release sdist --out dist

.PHONY: tests-sdist
tests-sdist: sdist ## build a wheel of it in isolation, and run its tests in a fresh folder and environment
	folder=$$(mktemp -d) && tar -xzf dist/rocksteady-*.tar.gz -C $$folder --strip-components 1 && \
		$(BIN)/python -m pip wheel --quiet --no-deps --wheel-dir $$folder/dist $$folder && \
		$(MAKE) -C $$folder tests && rm -rf $$folder

.PHONY: tests-wheel
tests-wheel: ## pytest on the wheel of this machine in dist/, in an environment of its own; LATEST=1: with the latest dependencies [what tests need]
	@rm -rf $(WHEEL)
	@$(call create-environment,$(WHEEL))
	$(WHEEL)/$(PROGRAMS)/python -m pip install --quiet --no-index --no-deps --find-links dist rocksteady
	$(WHEEL)/$(PROGRAMS)/python -m pip install --quiet $(if $(LATEST),--upgrade --upgrade-strategy eager,--constraint constraints.txt) 'rocksteady[cluster,records,stores]' $(WHEEL_NEEDS)
	$(WHEEL)/$(PROGRAMS)/rocksteady doctor --check
	$(WHEEL)/$(PROGRAMS)/python -m pytest -n $(WORKERS) --dist worksteal -o cache_dir=$(WHEEL)/pytest $(WHEEL_TESTS)

.PHONY: bill
bill: .venv ## the bill of materials in dist/: what the package needs, installed alone [+ build/bill]
	@rm -rf $(BILL) && mkdir -p dist && $(PYTHON) -m venv --without-pip $(BILL)
	$(BIN)/python -m uv pip install --quiet --python $(BILL) --constraint constraints.txt --requirements pyproject.toml
	@sed 's/^dynamic = .*/version = "$(VERSION)"/' pyproject.toml > $(BILL)/pyproject.toml
	$(BIN)/cyclonedx-py environment --pyproject $(BILL)/pyproject.toml --mc-type library --short-PURLs \
		--output-reproducible --output-file dist/rocksteady-$(VERSION).cdx.json $(BILL)

.PHONY: metadata
metadata: .venv ## write codemeta.json from pyproject.toml and CITATION.cff
	$(BIN)/python -m tools.release metadata

.PHONY: release
release: wheels sdist bill ## the files of a release in dist/: wheels, sources, bill of materials, recipe, hashes
	$(BIN)/python -m tools.release recipe --out dist
	cd dist && sha256sum rocksteady* > SHA256SUMS && cat SHA256SUMS

.PHONY: ready
ready: .venv ## whether a tag can be released: TAG=v0.1.0; what is missing, with what to do
	@$(BIN)/python -m tools.release check $(if $(TAG),--tag "$(TAG)")

.PHONY: site
site: docs ## manual and explorer as one folder for any host: out/site
	$(BIN)/python -m tools.release site --manual out/manual --out out/site

.PHONY: bench-gpu
bench-gpu: .venv library gpu ## measure the kernels on a GPU, ten minutes; writes its part of docs/benchmarks.md
	@mkdir -p out docs
	$(BIN)/python -m bench.gpu

.PHONY: mutants
mutants: .venv library ## change single places of modules, and list what their tests do not notice: PATHS=src/... [+ build/mutants]
	@test -n "$(PATHS)" || { echo "name modules or folders: make mutants PATHS=src/rocksteady/risk/fits" >&2; exit 1; }
	@rm -rf build/mutants && mkdir -p build/mutants && ln -s $(CURDIR)/src $(CURDIR)/tests $(CURDIR)/tools build/mutants
	@sed -e 's|^only_mutate = .*|only_mutate = [$(foreach path,$(PATHS),"$(path)*",)]|' \
		-e 's|^\(pytest_add_cli_args_test_selection\) = .*|\1 = [$(foreach path,$(TESTS),"$(path)",)]|' \
		pyproject.toml > build/mutants/pyproject.toml
	cd build/mutants && $(CURDIR)/$(BIN)/mutmut run --max-children $(WORKERS) && $(CURDIR)/$(BIN)/mutmut results
	@echo "one of them: cd build/mutants && $(CURDIR)/$(BIN)/mutmut show NAME"

.PHONY: gallery
gallery: .venv library ## draw every picture on one page, light and dark, wide and narrow, in grey: out/gallery
	$(BIN)/python -m tools.gallery

.PHONY: constraints
constraints: .venv ## renew constraints.txt with the newest versions that fit together: on any system, from Python 3.11.0
	@mkdir -p build
	@printf '%s\n' hatchling editables uv > build/backend.in
	$(BIN)/python -m uv pip compile --quiet --universal --python-version 3.11.0 --all-extras --upgrade --no-annotate \
		--no-header pyproject.toml build/backend.in --output-file build/constraints.txt
	@{ sed -n '/^#/p' constraints.txt; cat build/constraints.txt; } > build/constraints.new && mv build/constraints.new constraints.txt
	$(BIN)/python -m pytest -m "" tests/tools/test_constraints.py
	@echo "constraints.txt is renewed: run 'make test', then commit it."

.PHONY: clean
clean: ## remove .venv, caches and build folders; out/ stays [nothing]
	rm -rf .venv .bootstrap .benchmarks .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache build dist
	rm -rf docs/gallery docs/reference/commands docs/sg_execution_times.rst
	find src tests bench docs examples -name __pycache__ -type d -prune -exec rm -rf {} + 2>/dev/null || true

# A stamp holds the folder it was made in. A checkout that has moved gets a new environment, because
# the old one knows its scripts and the package by their paths; so does one whose Python is gone.
ifneq ($(shell test -x $(BIN)/python && cat $(BARE) 2>/dev/null),$(CURDIR))
.PHONY: $(BARE)
endif

# The build compiles the kernels (hatch_build.py): numba and a linker are in an environment of its own.
$(BARE): pyproject.toml constraints.txt
	@test "$$(cat $@ 2>/dev/null || echo none)" = "$(CURDIR)" || { rm -rf .venv; $(call create-environment,.venv); }
	@echo "Installing rocksteady into .venv, and compiling its kernels (one to two minutes)"
	@$(call install,.venv,--editable .)
	@echo "$(CURDIR)" > $@

# Here numba is in .venv itself: `make library` compiles, while other checks run.
$(STAMP): pyproject.toml constraints.txt
	@test "$$(cat $(BARE) $@ 2>/dev/null | tail -n 1)" = "$(CURDIR)" || { rm -rf .venv; $(call create-environment,.venv); }
	@echo "Installing rocksteady into .venv, with what its checks, its manual and its wheels need"
	@ROCKSTEADY_BUILD=pure; export ROCKSTEADY_BUILD; $(call install,.venv,--editable '.[$(EXTRAS)]')
	@echo "$(CURDIR)" > $@

ifneq ($(shell test -x $(FLOOR)/$(PROGRAMS)/python && cat $(FLOOR_STAMP) 2>/dev/null),$(CURDIR))
.PHONY: $(FLOOR_STAMP)
endif

$(FLOOR_STAMP): pyproject.toml constraints.txt | .venv
	@rm -rf $(FLOOR)
	@$(call create-environment,$(FLOOR))
	@echo "Installing the lower bounds into $(FLOOR)"
	@# What dependencies need themselves stays at or below the pins; matplotlib 3.10.0 warns under pyparsing 3.3.
	@sed 's/==/<=/; s/^pyparsing<=[^ ]*/pyparsing<=3.2.5/' constraints.txt > $(FLOOR)/caps.txt
	ROCKSTEADY_BUILD=pure $(BIN)/python -m uv pip install --quiet --python $(FLOOR) --resolution lowest-direct \
		--only-binary :all: --no-binary rocksteady --constraint $(FLOOR)/caps.txt --editable '.[$(EXTRAS)]'
	@echo "$(CURDIR)" > $@

# $(call install,ENVIRONMENT,WHAT): by uv, in a tenth of pip's time; by pip where uv is missing or cannot reach an
# index that pip is configured for. What fails shows its own last lines.
define install
python=$(1)/$(PROGRAMS)/python; log=$(1)/install.log; \
$$python -m uv pip install --python $$python --constraint constraints.txt --build-constraint constraints.txt $(2) >$$log 2>&1 || \
{ grep -qE "No module named uv|Failed to fetch|error sending request" $$log && \
	PIP_CONSTRAINT=constraints.txt $$python -m pip install --no-compile $(2) >$$log 2>&1; } || \
{ tail -n 25 $$log >&2; exit 1; }
endef

# $(call create-environment,FOLDER): a virtual environment with pip. Some systems ship python3
# without the part of venv that brings pip (ensurepip); virtualenv, fetched by pip into a folder of
# its own, does without it.
define create-environment
$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	echo "rocksteady needs Python 3.11 or newer, and '$(PYTHON)' is not: name one, as in make PYTHON=python3.12" >&2; \
	exit 1; \
}; \
said=$$($(PYTHON) -m venv $(1) 2>&1) || { \
	rm -rf $(1); \
	$(PYTHON) -m pip install --quiet --target .bootstrap virtualenv >/dev/null 2>&1 && \
	PYTHONPATH=.bootstrap $(PYTHON) -m virtualenv --quiet $(1) && \
	rm -rf .bootstrap; \
} || { \
	rm -rf .bootstrap $(1); \
	echo "$$said" >&2; \
	echo "$(PYTHON) cannot create a virtual environment (above): install its venv package (Debian, Ubuntu: apt install python3-venv)" >&2; \
	exit 1; \
}; \
$(1)/$(PROGRAMS)/python -m pip install --quiet --no-compile --constraint constraints.txt uv || echo "uv cannot be installed here: pip takes its place" >&2
endef

# $(call ahead,TARGET): starts a target in the background; the check of that name waits for it. Neither
# the lowering of kernels nor the check of types keeps two cores busy.
ahead = { $(MAKE) --no-print-directory $(1) >/dev/null 2>&1 & };

# $(call run-in-turn,TARGETS,MAKE,AT_FAILURE): one after the other, with their names, how long each took and what it
# left out; fails where one does, at once where AT_FAILURE is "exit 1;".
define run-in-turn
rm -rf $(NOT_RUN); mkdir -p $(NOT_RUN); \
summary=""; failed=""; began=$$(date +%s); \
for check in $(1); do \
	printf '\n== %s\n' "$$check"; \
	start=$$(date +%s); \
	$(2) --no-print-directory $$check || { printf '\n== %s failed\n' "$$check" >&2; failed="$${failed:-failed:} $$check"; $(3) }; \
	summary="$$summary$$(printf '\n   %-12s %4d s' "$$check" $$(($$(date +%s) - start)))"; \
	test ! -s $(NOT_RUN)/$$check || summary="$$summary   not run: $$(cat $(NOT_RUN)/$$check)"; \
done; \
printf '\n== %s in %d s%s\n' "$${failed:-all passed}" $$(($$(date +%s) - began)) "$$summary"; \
for each in $(BEYOND); do case " $(1) " in *" $$each "*) ;; *) left=1;; esac; done; \
test -z "$$left" || printf '   left to make test-all: %s\n' "$(LEFT)"; \
test -z "$$failed"
endef
