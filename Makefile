# armchat: make run | test | check | train | evals | fuzz
# Everything is installed into .venv, from requirements files with hashes.

SHELL := /bin/bash
PYTHON ?= $(shell command -v python3.11 || command -v python3)
BIN := .venv/bin
UV := VIRTUAL_ENV=.venv $(BIN)/uv pip install --quiet
EXTRAS ?=
FUZZ_SECONDS ?= 60

.PHONY: run test check train evals fuzz locks clean

run: .venv/.run
	$(if $(EXTRAS),$(UV) --editable '.[$(shell echo $(EXTRAS) | tr " " ",")]' --constraint requirements/test.txt)
	$(BIN)/armchat

# Whole files side by side, for tests of one file share what is slow to start; then what needs
# the machine for itself.
test: .venv/.test
	$(BIN)/pytest -m "not live" --numprocesses auto --maxprocesses 4 --dist loadfile
	$(BIN)/pytest $$(grep -l 'mark\.live' tests/test_*.py)

check: .venv/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

train: .venv/.test
	$(BIN)/armchat train --config configs/paper.toml --out runs/paper

evals: .venv/.test
	$(BIN)/armchat reproduce table1
	$(BIN)/armchat reproduce phrases
	$(BIN)/armchat reproduce phrases --known
	$(BIN)/armchat reproduce substitutions
	$(BIN)/armchat bench program
	$(BIN)/armchat bench language
	$(BIN)/armchat bench clarifier
	$(BIN)/armchat bench robot
	$(BIN)/armchat bench scene
	$(BIN)/armchat bench cold

# Coverage-guided fuzzing; an input that breaks something is left in fuzz-crashes/.
fuzz: .venv/.fuzz
	@mkdir -p fuzz-crashes
	@for target in scan frames; do \
		inputs=$$(mktemp -d); \
		$(BIN)/python tests/fuzz_$$target.py $$inputs -max_total_time=$(FUZZ_SECONDS) -timeout=10 -print_final_stats=1 -artifact_prefix=fuzz-crashes/$$target-; \
		status=$$?; rm -r $$inputs; [ $$status = 0 ] || exit $$status; \
	done

.venv/.uv: requirements/uv.txt
	@$(PYTHON) -c 'import sys; sys.exit("armchat needs Python 3.11, this is " + sys.version.split()[0] if sys.version_info[:2] != (3, 11) else 0)'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements/uv.txt
	@touch $@

.venv/.run: .venv/.uv requirements/run.txt pyproject.toml
	$(UV) --require-hashes -r requirements/run.txt
	$(UV) --no-deps --no-build-isolation --editable .
	@touch $@

.venv/.test: .venv/.run requirements/test.txt
	$(UV) --require-hashes -r requirements/test.txt
	@touch $@

.venv/.fuzz: .venv/.test requirements/fuzz.txt
	$(UV) --require-hashes -r requirements/fuzz.txt
	@touch $@

# Write the lock files anew (needs uv in .venv).
locks: .venv/.uv
	$(BIN)/uv pip compile --quiet --universal --generate-hashes --no-header --python-version 3.11 --extra sim --extra build pyproject.toml -o requirements/run.txt
	$(BIN)/uv pip compile --quiet --universal --generate-hashes --no-header --python-version 3.11 --extra sim --extra build --extra train --extra camera --extra dobot --extra dev pyproject.toml --constraint requirements/run.txt -o requirements/test.txt
	$(BIN)/uv pip compile --quiet --universal --generate-hashes --no-header --python-version 3.11 --extra fuzz pyproject.toml --constraint requirements/test.txt -o requirements/fuzz.txt
	echo uv | $(BIN)/uv pip compile --quiet --universal --generate-hashes --no-header --python-version 3.11 - -o requirements/uv.txt

clean:
	rm -rf .venv build *.egg-info
