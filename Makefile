# make demo: from nothing to a report on made-up recordings. Needs Python 3.11 or later and make.
PYTHON ?= python3
BIN := $(if $(filter Windows_NT,$(OS)),.venv/Scripts,.venv/bin)
CORES ?= all
SIZE ?= full
RESULTS ?= results
# For networks (config/README.md), which tests and papers train: 750 of 1,700 MB. Nothing else installs it; `TORCH=` never does.
TORCH ?= $(shell sed -n 's/^ *- \(torch==.*\)/\1/p' envs/torch.yaml)

.PHONY: demo docs pictures papers test test-library test-set test-papers test-cluster faults wheel lint config lock clean

demo: .venv/ready
	$(BIN)/python scripts/synthesize.py --folder demo/recordings --truth demo/truth --seed 1
	$(BIN)/snakemake --cores $(CORES) --config recordings=demo/recordings results=demo/results
	@echo
	@echo "$(CURDIR)/demo/results/report/index.html"

# The documentation as a site that works offline; every link in it is checked.
docs: .venv/ready
	rm -rf docs/_build docs/generated
	$(BIN)/sphinx-build --quiet --fail-on-warning --nitpicky --keep-going docs docs/_build/html
	$(BIN)/python docs/links.py docs/_build/html
	@echo "$(CURDIR)/docs/_build/html/index.html"

# The pictures of the documentation, from made-up recordings in Chromium: about ten minutes of one core.
pictures: .venv/ready
	PYTHONPATH=scripts:tests:. $(BIN)/python docs/pictures.py demo/pictures

# The experiments of the papers (config/evaluate): SIZE=quick takes minutes; RECORDINGS=FOLDER in place of a synthetic person.
papers: .venv/networks
	$(BIN)/snakemake --cores $(CORES) papers --configfile config/evaluate/$(SIZE).yaml --config results=$(RESULTS) \
		$(if $(RECORDINGS),"recordings=$(RECORDINGS)")
	@echo
	@echo "$(abspath $(RESULTS))/papers/index.html"

test: lint .venv/networks
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -q -n 2 --dist loadfile -m "not slow and not network and not cluster"

# The library without the workflow, as on macOS and Windows.
LIBRARY := core detection export filling formats mesh numerics options prediction repair simulation storage test_api.py test_portability.py
test-library: .venv/networks
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -q -n 2 --dist loadfile -m "not slow and not network" $(LIBRARY:%=tests/unit/%)

# The whole workflow on two small recordings, as the workflow catalog does it: half a minute.
test-set: .venv/ready
	$(BIN)/snakemake --directory .test --cores 2

# The experiments of the papers at quick size, on a synthetic person: some minutes.
test-papers: .venv/networks
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -q -m slow tests/workflow/test_papers.py

# A small SLURM cluster on this machine; skipped where SLURM is not installed, or without root.
test-cluster: .venv/ready
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -q -m cluster tests/workflow/test_cluster.py

# What faults do to results, FAULTS=kills for one kind: about twenty minutes of two cores for all.
faults: .venv/ready
	OMP_NUM_THREADS=1 PYTHONPATH=scripts:tests $(BIN)/python -m faults $(FAULTS)

# The package in an empty environment; needs a package index.
wheel: .venv/ready
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -q -m network

lint: .venv/ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	PYTHONPATH=scripts $(BIN)/lint-imports --no-cache
	$(BIN)/codespell

# What is made from the declared options: config/config.yaml, its schema, the tables of config/README.md,
# config/evaluate/full.yaml.
config: .venv/ready
	PYTHONPATH=scripts $(BIN)/python -m markermend.planning.config_files
	PYTHONPATH=scripts $(BIN)/python -m markermend.evaluation.options_file

# The newest versions of what pyproject.toml names; then bring envs/*.yaml in step.
lock: .venv/ready
	$(PYTHON) -m venv .venv-lock
	.venv-lock/bin/pip install --quiet uv
	.venv-lock/bin/uv pip compile --quiet --universal --fork-strategy fewest --generate-hashes --no-emit-index-url --no-emit-find-links \
		--python-version 3.11 --upgrade --custom-compile-command "make lock" --extra slurm --group dev pyproject.toml \
		--output-file requirements.lock
	rm -r .venv-lock

.venv/ready: requirements.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
		|| (echo "markermend needs Python 3.11 or later: make PYTHON=python3.11 $(MAKECMDGOALS)"; exit 1)
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --require-hashes --requirement requirements.lock
	touch $@

# The lock has the last word on what both need.
.venv/networks: .venv/ready envs/torch.yaml
	$(if $(TORCH),$(BIN)/pip install --quiet $(TORCH))
	$(BIN)/pip install --quiet --require-hashes --requirement requirements.lock
	touch $@

clean:
	rm -rf demo .venv .snakemake
