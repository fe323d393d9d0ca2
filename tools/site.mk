# The book and the slides. `make setup-site` installs what they need beyond a
# compiler; what comes from PyPI and npm goes under $(BUILD).
site_python := $(BUILD)/venv/bin/python

.PHONY: setup-site setup-live setup-slides site-programs book slides test-site

setup-site: setup
	@tools/setup.sh site

# For the box that the book paints in the browser; without it the box is still.
setup-live: setup
	@tools/setup.sh live

setup-slides: setup
	@tools/setup.sh slides

$(BUILD)/venv/made: tools/requirements.txt | setup-site
	@python3 -m venv $(BUILD)/venv
	@$(site_python) -m pip install --quiet -r $<
	@touch $@

$(BUILD)/node/made: tools/package.json | setup-site
	@mkdir -p $(BUILD)/node && cp $< $(BUILD)/node/
	@cd $(BUILD)/node && npm install --silent --no-audit --no-fund \
	  --ignore-scripts
	@touch $@

# Figures show what the stages paint, and what comparing two of them says.
site-programs: build
	@$(compile) stage-diff

book: site-programs $(BUILD)/venv/made $(BUILD)/node/made
	@$(site_python) -m tools.book.build

slides: site-programs setup-slides $(BUILD)/venv/made $(BUILD)/node/made
	@$(site_python) -m tools.slides.build

# What stops a build is tested on copies of the sources, what was built in a
# browser.
test-site: book slides
	@$(site_python) -m unittest tests/site/test_*.py tools/book/test_*.py
	@node --test --test-reporter=spec tests/site/*.test.cjs
