# Two commands matter: `make run` and `make test`; both set up everything they need.
PYTHON ?= python3
LEVEL ?= sample_levels/cove.shore
VENV := .venv/bin

.PHONY: run test lint bench pictures setup clients clean

run: setup
	@$(VENV)/python -m shorewright.app.launch $(LEVEL)

test: setup lint
	@$(VENV)/python -m pytest -n auto --dist loadfile --no-loadscope-reorder

lint: setup
	@$(VENV)/ruff check . && $(VENV)/ruff format --check . && $(VENV)/lint-imports --no-cache

bench: setup
	@$(VENV)/shorewright bench -o bench.json

pictures: setup
	@$(VENV)/python sample_levels/pictures.py

setup:
	@PYTHON=$(PYTHON) .ci/setup

clients:
	@.ci/clients

clean:
	rm -rf .venv .clients build *.egg-info out
