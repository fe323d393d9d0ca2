# The book and the slides. Packages from PyPI and npm go under $(BUILD), in the
# versions of the lock files that tools/setup/lock.sh writes.
site_python := $(BUILD)/site-venv/bin/python

.PHONY: site-programs book book-pdf slides test-site

$(BUILD)/node/made: tools/package.json tools/package-lock.json | setup-site
	@mkdir -p $(BUILD)/node && cp $^ $(BUILD)/node/
	@cd $(BUILD)/node && npm ci --silent --no-audit --no-fund --ignore-scripts
	@touch $@

# The figures need the stages' pictures, and comparisons of two stages.
site-programs: setup-site build
	@$(compile) stage-diff

book: site-programs $(BUILD)/site-venv/made $(BUILD)/node/made
	@$(site_python) -m tools.book.build

# The whole book for paper: build/book/lightwalk.pdf.
book-pdf: book setup-slides
	@$(site_python) -m tools.book.pdf

slides: site-programs setup-slides $(BUILD)/site-venv/made $(BUILD)/node/made
	@$(site_python) -m tools.slides.build

test-site: book slides
	@$(site_python) -m tests.site.run -j $(JOBS)
