# make demo   the six published scenarios, end to end between two processes
# make test   the test suite
# make check  formatting, lint, types, import directions
# make bench  the benchmarks at full size
# make fuzz   GAMES=5000 random games against brute force, from SEED on, the time of day by default
# make load   the test suite beside busy processes, then three times the tests of link, interrupt, resume
# make examples  what learners do with the environment, in the smallest size; installs PyTorch
# make lowest a part of the suite with the lowest version of each dependency that pyproject.toml allows
#
# Each target prepares .venv by itself from constraints.txt; Python 3.11 and make are enough.

PYTHON ?= python3
VENV   := .venv
LOWEST := .venv-lowest
BUSY   ?= 8
GAMES  ?= 5000
SEED   := $(or $(SEED),$(shell date +%s))
BIN    := $(VENV)/bin
PIP    := PIP_CONSTRAINT=$(CURDIR)/constraints.txt PIP_DISABLE_PIP_VERSION_CHECK=1 \
          $(BIN)/python -m pip install --quiet

# What the browser tests look at the report with, where there is npm.
AXE := $(if $(shell command -v npm),tests/report/node_modules/axe-core/axe.min.js)

# The test files with a mark: to collect all the others takes longer than to run these.
marked  = $$(grep -rl --include='test_*.py' 'mark\.$(1)' tests)
BESIDE  = $(BIN)/python -m tests.beside $(BUSY)

.PHONY: demo test check bench fuzz load lowest examples clean

demo: $(VENV)/.demo
	$(BIN)/testbed run configs/quickstart.yaml

test: $(VENV)/.test $(AXE)
	$(BIN)/python -m pytest -n 2 --dist worksteal

check: $(VENV)/.test
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: $(VENV)/.bench
	$(BIN)/python -m benchmarks

fuzz: $(VENV)/.test
	$(BIN)/python -m benchmarks.games $(GAMES) --seed $(SEED)

load: $(VENV)/.test
	$(BESIDE) $(BIN)/python -m pytest -n 2 --dist worksteal
	for round in 1 2 3; do $(BESIDE) $(BIN)/python -m pytest -n 2 --dist worksteal -m load $(call marked,load) || exit 1; done

lowest: $(VENV)/.test
	$(BIN)/uv venv --quiet --clear --python $(PYTHON) $(LOWEST)
	$(BIN)/uv pip install --quiet --python $(LOWEST) --resolution lowest-direct --editable '.[test,cluster]'
	$(LOWEST)/bin/python -m pytest -n 2 --dist worksteal -m versions $(call marked,versions)

examples: $(VENV)/.train
	$(BIN)/python examples/supersuit_vectors.py --games 2 --steps 40
	$(BIN)/python examples/torchrl_rollout.py --steps 10
	$(BIN)/python examples/train_adversary.py --robot traditional --steps 1024 --out $(VENV)/trained.npz

clean:
	rm -rf $(VENV) $(LOWEST)

$(VENV)/.demo: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(PIP) --editable .
	touch $@

$(VENV)/.test: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(PIP) --editable '.[test,cluster]'
	touch $@ $(VENV)/.demo

$(AXE): tests/report/package-lock.json
	npm ci --prefix tests/report --ignore-scripts --no-audit --no-fund
	touch $@

$(VENV)/.train: $(VENV)/.test
	$(PIP) --editable '.[test,cluster,train]'
	touch $@

$(VENV)/.bench: $(VENV)/.test
	$(PIP) --editable '.[test,cluster,bench]'
	touch $@
