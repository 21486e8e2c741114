# One command per task; `make help` lists them. Needed beforehand: python3 (3.11 or newer), make and
# git. Everything else is installed into .venv, in the versions that constraints.txt names.

PYTHON ?= python3
WORKERS ?= 2
MARKS ?= not slow

# Windows has the programs of an environment in another folder.
PROGRAMS := $(if $(filter Windows_NT,$(OS)),Scripts,bin)
BIN := .venv/$(PROGRAMS)
BARE := .venv/.bare
LOWERS := .venv/.lowers
STAMP := .venv/.installed
FLOOR := build/floor
FLOOR_STAMP := $(FLOOR)/.installed
WHEEL := build/wheel
# What the tests of the package import; those of pages, pictures and tools need the checkout's environment.
WHEEL_NEEDS := hypothesis mpmath psutil pytest pytest-xdist python-flint statsmodels
WHEEL_TESTS := $(addprefix tests/,dynamics kernels model records results risk seismic sweep)
INSTALL := pip install --quiet --no-compile --constraint constraints.txt
EXTRAS := bench,build,cluster,dev,docs,gpu,jit,records,stores
PEERS := heyoka mujoco
# What tests-floor runs: where each dependency of the package and of its extras cluster, proof and records is
# called. Left out are the kernels in their library and most of dynamics, which call NumPy alone, studies and
# commands, which call what is run here, and tests of pages, tools and the manual. The examples of all docstrings
# are in tests/public.
FLOOR_TESTS := $(addprefix tests/,certify cli/console cli/flags cli/test_app.py dynamics/basins \
	dynamics/continuation/chains kernels/machine_code model public records results risk/assess/described \
	risk/back_analysis risk/calibration risk/ensemble risk/facades risk/fits risk/fragility risk/free_rocking \
	risk/hazard risk/observations risk/screens seismic show/export show/figures show/film show/plots show/style sweep)
CHECKS := lint types layers library pages tests uncompiled programs
# Seconds that each check may take on two cores, printed beside those that it took.
BUDGETS := lint=15 types=65 layers=5 library=60 pages=5 docs=240 tests=330 uncompiled=5 tests-python=70 programs=5 ptx=150 tests-jit=300 tests-floor=200 frozen-all=480

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules

# The same result from any shell: what another environment, a user's pip settings or a debugging
# session has exported must reach neither the installation nor the checks.
unexport VIRTUAL_ENV CONDA_PREFIX PYTHONHOME PYTHONPATH PYTHONSTARTUP PYTHONWARNINGS PYTHONOPTIMIZE
unexport PYTHONDONTWRITEBYTECODE
unexport PIP_TARGET PIP_PREFIX PIP_ROOT PIP_CONSTRAINT PIP_REQUIREMENT PIP_NO_DEPS PIP_DRY_RUN
unexport MYPYPATH NUMBA_DISABLE_JIT ROCKSTEADY_KERNELS
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
	@printf '\nWhat each installs first, unless it is there: [numba]; [package], which is rocksteady and numba; [nothing];\n'
	@printf 'all others also what checks, manual, benchmarks and wheels need, and what stands behind +.\n'

.PHONY: demo
demo: $(LOWERS) ## do a whole paper again, and film a block that falls; pictures and a report in out/ [package]
	@mkdir -p out
	@# The kernels need numba alone, and no package: beside them the rest is installed and imported once,
	@# so that it is compiled and fonts are listed, and the film made, which plain Python computes as fast.
	@$(call side-by-side,$(MAKE) --no-print-directory kernels,$(MAKE) --no-print-directory $(BARE) && \
		$(BIN)/python -c "import fontTools.subset; import matplotlib.pyplot; import scipy.ndimage; import xarray; import rocksteady.studies.tso_wong_1989.study" && \
		ROCKSTEADY_KERNELS=python $(BIN)/rocksteady simulate --block tso-wong-1989 -A 2 -W 1.7 --start steady --cycles 40 \
			--plot out/simulate.png --animate out/simulate.gif --force)
	$(BIN)/rocksteady paper --out out/tso-wong-1989 --force

.PHONY: explore
explore: .venv library ## write the explorer, a page to touch, and open it in the browser
	@mkdir -p out
	$(BIN)/rocksteady explore --out out/explorer.html --force

.PHONY: test
test: $(LOWERS) ## run every check, the tests marked slow excepted
	@$(call installed-beside-kernels) $(call ahead,library) $(call run-in-turn,$(CHECKS),$(MAKE),exit 1;)

.PHONY: test-all
test-all: BUDGETS += tests=1300
test-all: $(LOWERS) ## run every check to its end, the tests marked slow and the lower bounds included
	@$(call installed-beside-kernels) $(call ahead,library) $(call ahead,warm) \
		$(call run-in-turn,$(patsubst pages,docs,$(patsubst programs,ptx,$(patsubst uncompiled,tests-python,$(CHECKS)))) tests-jit tests-floor frozen-all,$(MAKE) MARKS=)

##@ One check at a time

.PHONY: lint
lint: .venv ## ruff: rules and format; code lines, and what has grown beyond easy reading
	$(BIN)/python -m ruff check
	$(BIN)/python -m ruff format --check
	@$(BIN)/python -m tools.count

.PHONY: types
types: .venv ## mypy --strict over src and tests, and tsc over the page where there is one
	$(BIN)/python -m mypy --num-workers $(WORKERS)
	@$(BIN)/python -m tools.page

.PHONY: layers
layers: .venv ## import-linter: who may import whom
	$(BIN)/lint-imports --no-logo

.PHONY: tests
tests: .venv library $(if $(filter not,$(MARKS)),,gpu) ## pytest, kernels from the library (MARKS= runs the slow ones too)
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal -m "$(MARKS)"

.PHONY: tests-python
tests-python: .venv ## the kernels' tests once more as plain Python
	ROCKSTEADY_KERNELS=python $(BIN)/python -m pytest tests/kernels -n $(WORKERS) --dist worksteal
	@$(BIN)/python -m tools.done uncompiled --write

.PHONY: uncompiled
uncompiled: .venv ## tests-python, where kernels or their tests have changed since they passed (tests/kernels/.passed)
	@$(BIN)/python -m tools.done uncompiled || $(MAKE) --no-print-directory tests-python

.PHONY: ptx
ptx: .venv .venv/.ptxas ## ptxas over the programs for GPUs, where it can be installed [+ ptxas]
	$(BIN)/python -m tools.aot.device check --architectures sm_90
	@test ! -s .venv/.ptxas || $(BIN)/python -m tools.done ptx --write

.PHONY: programs
programs: .venv ## ptx, where kernels or tools have changed since it passed (tools/aot/device/.assembled)
	@$(BIN)/python -m tools.done ptx || $(MAKE) --no-print-directory ptx

.PHONY: docs
docs: .venv library ## build the manual into out/manual; its tutorials and gallery are computed
	@# Sphinx leaves the pages of what is gone: what it writes is written anew.
	@rm -rf out/manual && mkdir -p out
	env -u MPLBACKEND $(BIN)/python -m sphinx --jobs $(WORKERS) --fail-on-warning --keep-going --quiet \
		--doctree-dir build/manual/doctrees docs out/manual
	@$(BIN)/python -m tools.done manual --write

.PHONY: pages
pages: .venv ## the manual, where its pages have changed since it was built (docs/.built)
	@$(BIN)/python -m tools.done manual || $(MAKE) --no-print-directory docs

.PHONY: tests-jit
tests-jit: warm ## the kernels' tests, kernels compiled by numba
	ROCKSTEADY_KERNELS=jit $(BIN)/python -m pytest -q -m slow tests/kernels/test_entries.py
	ROCKSTEADY_KERNELS=jit $(BIN)/python -m pytest -n $(WORKERS) tests/kernels

.PHONY: tests-floor
tests-floor: $(FLOOR_STAMP) library ## tests that call dependencies, each at its lower bound, the slow tests excepted [+ build/floor]
	@# numba at its bound compiles the march alone: all entries would take six minutes.
	ROCKSTEADY_KERNELS=jit $(FLOOR)/$(PROGRAMS)/python -m pytest -o cache_dir=$(FLOOR)/pytest tests/kernels/march
	@# Answers are recorded with the versions of constraints.txt, whose words some of them hold.
	$(FLOOR)/$(PROGRAMS)/python -m pytest -n $(WORKERS) --dist worksteal -o cache_dir=$(FLOOR)/pytest \
		--ignore tests/public/test_recorded.py $(FLOOR_TESTS)

##@ Upkeep

.PHONY: library
library: .venv ## compile the kernels into a library for this machine, unless that is done
	@$(BIN)/python -m tools.aot host --page
	@$(BIN)/python -m tools.aot.web.program

.PHONY: kernels
kernels: $(LOWERS) ## the same without the explorer's page, and before the package is installed [numba]
	@PYTHONPATH=src $(BIN)/python -m tools.aot host

.PHONY: warm
warm: .venv ## compile the kernels with numba once, so that each worker of tests-jit loads them
	ROCKSTEADY_KERNELS=jit $(BIN)/python -m rocksteady.kernels.entries

.PHONY: gpu
gpu: .venv ## compile the kernels for GPUs, for the executor "gpu"
	@$(BIN)/python -m tools.aot.device build

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
	$(BIN)/python -m tools.aot.device build --out build/libraries --architectures sm_80
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
	$(WHEEL)/$(PROGRAMS)/python -m pip install --quiet $(if $(LATEST),--upgrade --upgrade-strategy eager,--constraint constraints.txt) 'rocksteady[cluster,jit,records]' $(WHEEL_NEEDS)
	$(WHEEL)/$(PROGRAMS)/rocksteady doctor --check
	$(WHEEL)/$(PROGRAMS)/python -m pytest -n $(WORKERS) --dist worksteal -o cache_dir=$(WHEEL)/pytest $(WHEEL_TESTS)

.PHONY: metadata
metadata: .venv ## write codemeta.json from pyproject.toml and CITATION.cff
	$(BIN)/python -m tools.release metadata

.PHONY: release
release: wheels sdist ## the files of a release in dist/: wheels, sources, bill of materials, recipe, hashes
	$(BIN)/python -m tools.release bill --out dist
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

.PHONY: resources
resources: .venv gpu .venv/.ptxas ## what the kernels take of a GPU, by ptxas; writes its part of docs/benchmarks.md
	$(BIN)/python -m bench.gpu.resources

.PHONY: mutants
mutants: .venv library ## change single places of the sources, and count what tests notice: an hour
	$(BIN)/python -m tools.mutants

.PHONY: gallery
gallery: .venv library ## draw every picture on one page, light and dark, wide and narrow, in grey: out/gallery
	$(BIN)/python -m tools.gallery

.PHONY: architecture
architecture: .venv ## draw docs/images/architecture.png and its table from the imports
	$(BIN)/python -m tools.architecture

.PHONY: constraints
constraints: ## renew constraints.txt with the newest versions that fit together
	@rm -rf build/constraints
	@$(call create-environment,build/constraints)
	build/constraints/$(PROGRAMS)/python -m pip install --quiet hatchling editables '.[$(EXTRAS)]'
	@{ \
		echo "# The exact version of everything that the package and its extras ($(EXTRAS)) install, under the"; \
		echo "# oldest supported Python: what .venv holds and what every check runs with. Renewed as a whole"; \
		echo "# by 'make constraints', never by hand; pyproject.toml holds the lower bounds."; \
		build/constraints/$(PROGRAMS)/python -m pip freeze --exclude rocksteady; \
	} > build/constraints.txt
	@mv build/constraints.txt constraints.txt
	@rm -rf build/constraints
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
ifneq ($(shell test -x $(BIN)/python && cat $(LOWERS) 2>/dev/null),$(CURDIR))
.PHONY: $(LOWERS)
endif

# What compiles kernels: numba, which tries to import scipy, and zig where there is no compiler of C.
# The build back end first, pinned like the rest: an isolated build would fetch its own. Modules
# become bytecode as they are imported, most of them never.
$(LOWERS): pyproject.toml constraints.txt
	@{ test "$$(cat $@ 2>/dev/null || echo "$(CURDIR)")" = "$(CURDIR)" && $(BIN)/python -m pip --version >/dev/null 2>&1; } || \
		{ rm -rf .venv; $(call create-environment,.venv); }
	@echo "Installing rocksteady into .venv"
	@$(BIN)/python -m $(INSTALL) hatchling editables filelock lazy-loader platformdirs numba scipy \
		$$(command -v gcc clang >/dev/null || echo ziglang)
	@echo "$(CURDIR)" > $@

# And what else runs the package.
$(BARE): $(LOWERS)
	@$(BIN)/python -m $(INSTALL) --no-build-isolation --editable '.[jit]'
	@echo "$(CURDIR)" > $@

$(STAMP): $(BARE)
	@echo "Installing what its checks, its manual and its wheels need (about a minute)"
	@$(BIN)/python -m $(INSTALL) --no-build-isolation --editable '.[$(EXTRAS)]'
	@echo "$(CURDIR)" > $@

# The assembler of PTX: without what its wheel depends on, a compiler of C++. Where it cannot be
# installed, what needs it says so and goes on.
.venv/.ptxas: tools/aot/device/constraints.txt | .venv
	@if $(BIN)/python -m pip install --quiet --no-deps --only-binary :all: --requirement $<; \
		then echo installed > $@; \
		else echo "ptxas cannot be installed here" >&2; : > $@; fi

ifneq ($(shell test -x $(FLOOR)/$(PROGRAMS)/python && cat $(FLOOR_STAMP) 2>/dev/null),$(CURDIR))
.PHONY: $(FLOOR_STAMP)
endif

$(FLOOR_STAMP): pyproject.toml constraints.txt tools/floor.py
	@rm -rf $(FLOOR)
	@$(call create-environment,$(FLOOR))
	@echo "Installing the lower bounds into $(FLOOR) (about a minute)"
	$(FLOOR)/$(PROGRAMS)/python tools/floor.py > $(FLOOR)/constraints.txt
	@# Wheels alone: an old release that must be built depends on the compilers of the machine.
	$(FLOOR)/$(PROGRAMS)/python -m pip install --quiet --only-binary :all: --constraint $(FLOOR)/constraints.txt hatchling editables
	$(FLOOR)/$(PROGRAMS)/python -m pip install --quiet --only-binary :all: --constraint $(FLOOR)/constraints.txt --no-build-isolation --editable '.[$(EXTRAS)]'
	$(FLOOR)/$(PROGRAMS)/python -m pip check
	@echo "$(CURDIR)" > $@

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
}
endef

# $(call side-by-side,COMMAND,COMMAND): both; fails where one does.
side-by-side = $(1) & $(2); second=$$?; wait $$! && exit $$second

# $(call ahead,TARGET): starts a target in the background; the check of that name waits for it. Neither
# the lowering of kernels nor the check of types keeps two cores busy.
ahead = { $(MAKE) --no-print-directory $(1) >/dev/null 2>&1 & };

# Installs the rest while the kernels are compiled: numba and a compiler of C are all that these need.
installed-beside-kernels = $(call ahead,kernels) $(MAKE) --no-print-directory .venv || exit 1;

# $(call run-in-turn,TARGETS,MAKE,AT_FAILURE): one after the other, with their names, how long each took
# and its budget; fails where one does, at once where AT_FAILURE is "exit 1;".
define run-in-turn
summary=""; failed=""; began=$$(date +%s); \
for check in $(1); do \
	printf '\n== %s\n' "$$check"; \
	start=$$(date +%s); \
	$(2) --no-print-directory $$check || { printf '\n== %s failed\n' "$$check" >&2; failed="$${failed:-failed:} $$check"; $(3) }; \
	budget=$$(printf '%s\n' $(BUDGETS) | sed -n "s/^$$check=//p" | tail -n 1); \
	summary="$$summary$$(printf '\n   %-12s %4d s of %3d' "$$check" $$(($$(date +%s) - start)) "$$budget")"; \
done; \
printf '\n== %s%s\n   %-12s %4d s\n' "$${failed:-all passed}" "$$summary" total $$(($$(date +%s) - began)); \
test -z "$$failed"
endef
