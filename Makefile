# make run    sets up once, then opens the window (a picture where there is no display)
# make test   sets up once, then style, types and tests
# make bench  side-by-side measurements      make lock   newer versions of the dependencies
# make wheel  dist/solidtree-*.whl           make clean  back to a fresh clone, .venv included

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready
TOOLS := .venv/.tools
PIP := $(BIN)/python -m pip install --disable-pip-version-check -q
EXAMPLE := resources/examples/dumbbell.solidtree
XVFB := xvfb-run -a -s '-screen 0 1600x1000x24'
COMPILE := --universal --generate-hashes --custom-compile-command "make lock" -q pyproject.toml
export PYTHON

.PHONY: run test bench lock wheel clean
.DELETE_ON_ERROR:

run: $(READY)
	@.ci/system-packages
	@if [ -n "$${DISPLAY:-}$${WAYLAND_DISPLAY:-}" ] || [ "$$(uname)" = Darwin ]; then \
		$(BIN)/solidtree $(EXAMPLE); \
	else \
		echo "There is no display to open a window on, so the dumbbell is rendered to dumbbell.png."; \
		$(BIN)/solidtree render $(EXAMPLE) dumbbell.png; \
	fi

test: $(READY) $(TOOLS)
	@.ci/system-packages xvfb-run xauth
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	PYRIGHT_PYTHON_IGNORE_WARNINGS=1 $(BIN)/pyright
	@if [ "$$(uname)" = Linux ]; then set -- $(XVFB); else set --; fi; \
	LC_ALL=C.UTF-8 "$$@" $(BIN)/python -m pytest $(ARGS)

bench: $(READY)
	@[ -n "$${DISPLAY:-}" ] || .ci/system-packages xvfb-run xauth
	@set --; [ -n "$${DISPLAY:-}" ] || [ "$$(uname)" != Linux ] || set -- $(XVFB); \
	for script in $$(grep -l __main__ bench/*.py); do echo "== $$script"; "$$@" $(BIN)/python $$script || exit 1; done

$(READY): requirements.lock pyproject.toml model/partition/bsp.cpp model/partition/proximity.cpp
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "Solidtree needs Python 3.11 or newer; name one with: make PYTHON=python3.12"; exit 1; }
	@.ci/system-packages
	@$(BIN)/python -m pip --version >/dev/null 2>&1 || $(PYTHON) -m venv .venv
	@echo "Installing the locked dependencies into .venv; this happens once and takes a minute or two."
	@$(PIP) --require-hashes -r requirements.lock
	@$(PIP) --no-deps --no-build-isolation -e .
	@touch $@

$(TOOLS): $(READY) requirements-dev.lock
	@echo "Installing the tools for tests."
	@$(PIP) --require-hashes -r requirements-dev.lock
	@touch $@

lock:
	$(PYTHON) -m venv build/uv
	build/uv/bin/pip install -q uv
	build/uv/bin/uv pip compile --upgrade $(COMPILE) --group dev -o requirements-dev.lock
	build/uv/bin/uv pip compile $(COMPILE) -c requirements-dev.lock --group build -o requirements.lock

wheel: $(READY)
	rm -rf build/lib build/bdist.*
	$(BIN)/python -m pip wheel -q --no-deps --no-build-isolation -w dist .

clean:
	rm -rf .venv build dist *.egg-info .pytest_cache .ruff_cache .hypothesis dumbbell.png model/partition/bsp.*so
	find . -name __pycache__ -prune -exec rm -rf {} +
