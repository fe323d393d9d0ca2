# The book and the slides. What comes from PyPI and npm goes under $(BUILD), by
# the lock files that tools/setup/lock.sh writes.
site_python := $(BUILD)/site-venv/bin/python

.PHONY: site-programs book slides test-site

$(BUILD)/node/made: tools/package.json tools/package-lock.json | setup-site
	@mkdir -p $(BUILD)/node && cp $^ $(BUILD)/node/
	@cd $(BUILD)/node && npm ci --silent --no-audit --no-fund --ignore-scripts
	@touch $@

# Figures show what the stages paint, and what comparing two of them says.
site-programs: build
	@$(compile) stage-diff

book: site-programs $(BUILD)/site-venv/made $(BUILD)/node/made
	@$(site_python) -m tools.book.build

slides: site-programs setup-slides $(BUILD)/site-venv/made $(BUILD)/node/made
	@$(site_python) -m tools.slides.build

test-site: book slides
	@$(site_python) -m tests.site.run -j $(JOBS)
