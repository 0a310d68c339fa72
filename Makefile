# make               set up .venv and build the scenes that config/config.yaml names
# make test          the same set-up, and the tests
# make test-slurm    a trial of the workflow on a Slurm cluster that it starts here (needs root)
# make report        results/SCENE/report.html: everything about a scene in one file for a browser
# make bench         the benchmarks, as a table
# make clean         remove .venv and what tools leave behind; results stay
# make requirements  pin the newest versions again (needs uv)

SCENE ?= river_gravel
PYTHON ?= $(or $(shell command -v python3.11),python3)
BIN := .venv/bin
# What runs below finds this environment's tools first.
RUN := PATH="$(CURDIR)/$(BIN):$$PATH"

# Hashed and without addresses, for all platforms.
PIN := uv pip compile --quiet --universal --python-version 3.11 --upgrade --generate-hashes \
    --no-header --no-annotate

.DEFAULT_GOAL := results
.PHONY: results test test-slurm report bench clean requirements

results: .venv/installed
	$(RUN) snakemake

test: .venv/installed-dev
	$(RUN) pytest

test-slurm: .venv/installed-slurm
	$(RUN) python tests/slurm/run.py

report: .venv/installed
	$(RUN) snakemake --config 'scenes=[$(SCENE)]'
	$(RUN) snakemake --config 'scenes=[$(SCENE)]' --report results/$(SCENE)/report.html

bench: .venv/installed
	$(RUN) python benchmarks/run.py

clean:
	rm -rf .venv .snakemake .pytest_cache .mypy_cache .ruff_cache .hypothesis build

requirements:
	$(PIN) --output-file requirements.txt pyproject.toml
	$(PIN) --constraint requirements.txt --extra dev --output-file requirements-dev.txt pyproject.toml
	$(PIN) --constraint requirements.txt --extra slurm --output-file requirements-slurm.txt pyproject.toml

# The marks are newer than what they were made from, so that an environment is set up once.
.venv/installed: requirements.txt pyproject.toml
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --require-hashes --requirement requirements.txt
	$(BIN)/python -m pip install --quiet --no-deps --editable .
	touch $@

.venv/installed-dev: .venv/installed requirements-dev.txt
	$(BIN)/python -m pip install --quiet --require-hashes --requirement requirements-dev.txt
	touch $@

.venv/installed-slurm: .venv/installed requirements-slurm.txt
	$(BIN)/python -m pip install --quiet --require-hashes --requirement requirements-slurm.txt
	touch $@
