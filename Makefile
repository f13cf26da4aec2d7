# rt: a ray tracer in C11 and OpenCL C. `make help` lists what can be made, README.md says more.
# Builds in the current folder: from another one, make -f PATH/Makefile.

# Where the sources are, with a slash, or nothing where that is here.
MAKEFILE := $(lastword $(MAKEFILE_LIST))
SRC := $(filter-out ./,$(dir $(MAKEFILE)))

# ---- What is yours to set: these, and CPPFLAGS LDFLAGS LDLIBS DESTDIR ----

CFLAGS ?= -O2 -g
# -Werror where changes are checked, as .ci/run does; not where others build with compilers to come.
WERROR ?=
# Holds everything that is made except ./rt; make asan keeps its own in there.
BUILD ?= build
PKG_CONFIG ?= pkg-config
INSTALL ?= install
# The name to install under: rt5-clients has /usr/bin/rt in Debian.
PROGRAM ?= rt

PREFIX ?= /usr/local
prefix = $(PREFIX)
exec_prefix = $(prefix)
bindir = $(exec_prefix)/bin
datarootdir = $(prefix)/share
datadir = $(datarootdir)
mandir = $(datarootdir)/man
docdir = $(datarootdir)/doc/$(PROGRAM)
bashcompletiondir = $(datadir)/bash-completion/completions
zshcompletiondir = $(datadir)/zsh/site-functions

# make V=1 shows whole commands.
Q := $(if $(V),,@)
say = @$(if $(V),:,printf '  %-6s %s\n' $(1)) $@

# ---- Flags ----

LIBRARIES := OpenCL jansson libdeflate
# pkg-config knows OpenEXR with its C++ libraries alone; its core, in C, needs none of them.
CFLAGS_LIBRARIES := $(LIBRARIES) OpenEXR
# Asked only when something is compiled, since `make demo` installs pkg-config first.
PKG_CFLAGS = $(shell $(PKG_CONFIG) --cflags $(CFLAGS_LIBRARIES) stb)
PKG_LIBS = $(shell $(PKG_CONFIG) --libs $(LIBRARIES)) \
           $(shell $(PKG_CONFIG) --libs-only-L OpenEXR) -lOpenEXRCore

WARNINGS := -Wall -Wextra -Wshadow -Wconversion $(WERROR)
# After CFLAGS, since these are what the bits of a picture rest on: a multiply-add is fused where the
# code says fma, and nowhere else, and sums are taken in the order that is written.
EXACT := -fno-fast-math -ffp-contract=off
ALL_CPPFLAGS = -I$(SRC)src -I$(SRC). $(if $(SRC),-fmacro-prefix-map=$(SRC)=) $(CPPFLAGS)
ALL_CFLAGS = -std=c11 -pthread $(WARNINGS) $(CFLAGS) $(EXACT) $(MORE_CFLAGS)
COMPILE = $(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<
LINK = $(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $(filter %.o,$^)
LIBS = $(PKG_LIBS) $(LDLIBS) -lm
TEST_CPPFLAGS = $(shell $(PKG_CONFIG) --cflags $(CFLAGS_LIBRARIES) stb cmocka) -I$(SRC)tests
FLAGS := $(BUILD)/flags

# ---- Files ----

# In the order in which program.c and check-kernels put them together.
KERNELS := $(addprefix $(SRC)kernels/,effects.def parts.h primitives/kinds.h options.h layout.h margins.h \
           $(addprefix lib/,real.h vec3.cl sampling.cl tile.cl) \
           primitives/intersect.cl traversal/packet.cl \
           $(addprefix shading/,surface.cl pattern.cl media.cl) \
           $(addprefix primitives/,sphere.cl watertight.cl triangle.cl) traversal/traverse.cl \
           $(addprefix stages/,camera.cl trace.cl probe.cl path.cl shade.cl queue.cl resolve.cl))

SOURCES := $(wildcard $(SRC)src/*.c $(SRC)src/*/*.c)
HEADERS := $(wildcard $(SRC)src/*/*.h $(SRC)src/*/*.def)
# The scalar reference is compiled twice, for float and for double; stb's code is compiled as it is.
OBJECTS := $(SOURCES:$(SRC)src/%.c=$(BUILD)/%.o) $(BUILD)/opencl/kernel_text.o \
           $(patsubst $(SRC)src/%.c,$(BUILD)/%_double.o,$(wildcard $(SRC)src/reference/*.c))
LIBRARY := $(filter-out $(BUILD)/main.o,$(OBJECTS))
TESTS := $(patsubst $(SRC)%.c,$(BUILD)/%,$(wildcard $(SRC)tests/*/test_*.c))
TEST_HELPERS := $(patsubst $(SRC)%.c,$(BUILD)/%.o,$(filter-out $(SRC)tests/hard/test_% \
                $(SRC)tests/truth/test_%,$(wildcard $(patsubst %,$(SRC)tests/%/*.c,support hard truth))))

# ---- The program ----

.DELETE_ON_ERROR:
.SECONDARY:

.PHONY: all
all: rt ## builds ./rt

rt: $(BUILD)/rt
	@cp -f $< $@

$(BUILD)/rt: $(OBJECTS) $(FLAGS)
	$(call say,LINK)
	$(Q)$(LINK) $(LIBS)

# What everything is made of is made anew when the flags change: this file does only then. Except by
# make install, which takes what is built.
$(FLAGS): export text = $(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) $(LDFLAGS) $(LDLIBS)
$(FLAGS): $(if $(filter install install-strip,$(MAKECMDGOALS)),,FORCE)
	@mkdir -p $(@D)
	@echo "$$text" | cmp -s - $@ || echo "$$text" >$@
.PHONY: FORCE

$(BUILD)/%.o: $(SRC)src/%.c $(FLAGS)
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(PKG_CFLAGS)

# Its JPEG code shifts into the sign bit; that is the library's, and harmless. Its loops over a
# picture's bytes are vectorised at -O3 only.
$(BUILD)/image/stb_write.o $(BUILD)/image/stb_read.o: private MORE_CFLAGS := -O3 -fno-sanitize=undefined
$(BUILD)/image/png.o: private MORE_CFLAGS := -O3

$(BUILD)/%_double.o: $(SRC)src/%.c $(FLAGS)
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -DRT_SCALAR_DOUBLE

$(BUILD)/opencl/kernel_text.o: $(BUILD)/opencl/kernel_text.c $(FLAGS)
	$(call say,CC)
	$(Q)$(COMPILE)

$(BUILD)/opencl/kernel_text.c: $(SRC)src/opencl/kernel_text.awk $(KERNELS)
	$(call say,GEN)
	@mkdir -p $(@D)
	$(Q)awk -f $< $(KERNELS) >$@

# ---- Tests ----

# Tests name scenes/ and kernels/, so they run where these are; files of ours are then far from there.
in_source = cd $(or $(SRC),.) &&
from_source = $(if $(SRC),$(abspath $(1)),$(1))
remake = +@$(MAKE) --no-print-directory -f $(MAKEFILE)

# Two commands on a fresh machine: both install what is missing and say nothing when nothing is.
.PHONY: demo test check
demo: deps ## installs what is missing, builds, renders icecream.png
	$(remake) rt
	./rt $(SRC)scenes/icecream.txt icecream.png

test: deps ## installs what is missing, builds, runs every test
	$(remake) check

check: rt $(TESTS) ## builds and runs every test, and looks for no packages
	@$(SRC)tests/links
	@$(in_source) RT=$(call from_source,./rt) tests/run $(call from_source,$(TESTS))

# The long forms: the hard cases with 40 times the rays, every lane width, build and mutant.
LONG_TESTS = $(filter $(BUILD)/tests/hard/% $(patsubst $(SRC)%.c,$(BUILD)/%,\
             $(shell grep -l test_is_long $(SRC)tests/*/test_*.c)),$(TESTS))
.PHONY: test-hard check-hard
test-hard: deps ## runs the long forms: hard cases with 10 M rays, every lane width and mutant
	$(remake) check-hard

check-hard: rt $(LONG_TESTS)
	@$(in_source) RT=$(call from_source,./rt) RT_TEST_LONG=1 RT_HARD_RAYS=$${RT_HARD_RAYS:-10000000} \
	    RT_HARD_TABLE=$(call from_source,$(BUILD)/hard.md) tests/run $(call from_source,$(LONG_TESTS))
	@$(in_source) RT=$(call from_source,./rt) tests/hard/table $(call from_source,$(BUILD)/hard.md)

.PHONY: test-truth check-truth
test-truth: deps ## holds whole pictures against the truth at 67 counts of samples: minutes
	$(remake) check-truth

check-truth: rt $(BUILD)/tests/truth/test_truth
	@rm -f $(BUILD)/truth.md
	@$(in_source) RT_TRUTH_TABLE=$(call from_source,$(BUILD)/truth.md) \
	    $(call from_source,$(BUILD)/tests/truth/test_truth)
	@$(in_source) RT=$(call from_source,./rt) tests/truth/table $(call from_source,$(BUILD)/truth.md)

.PHONY: test-processors
test-processors: deps deps-processors ## renders as processors with AVX2 and with SSE4 alone do, by qemu
	$(remake) rt
	@$(in_source) tests/processors $(call from_source,./rt) $(call from_source,$(BUILD)/processors)

# Kernels that are wrong by one token, and those that no test of their stage notices:
# make mutants FILE=kernels/stages/shade.cl MOST=40 SEED=1
FILE ?= $(patsubst $(SRC)%,%,$(filter %.cl %/real.h,$(KERNELS)))
MOST ?= 3
SEED ?= 1

.PHONY: mutants
mutants: rt $(TESTS) ## changes kernels by a token and tells what no test notices; FILE= MOST= SEED=
	@$(in_source) RT=$(call from_source,./rt) BUILD=$(call from_source,$(BUILD)) tests/mutants $(MOST) $(SEED) $(FILE)

$(BUILD)/tests/%.o: $(SRC)tests/%.c $(FLAGS)
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(TEST_CPPFLAGS)

$(TESTS): %: %.o $(TEST_HELPERS) $(LIBRARY) $(FLAGS)
	$(call say,LINK)
	$(Q)$(LINK) -lcmocka -lgmp $(LIBS)

# On PoCL alone, whose leaks are known: what other drivers keep is not ours either.
# LLVM, in the thread that opens devices, sets a signal stack of its own, which the sanitizer would
# take for its own.
.PHONY: asan check-asan
asan: deps ## runs every test under the address and undefined-behaviour sanitizers
	@OCL_ICD_VENDORS=$${OCL_ICD_VENDORS:-$$(ls /etc/OpenCL/vendors/pocl.icd 2>/dev/null)} \
	ASAN_OPTIONS=detect_leaks=1:use_sigaltstack=0 \
	LSAN_OPTIONS=suppressions=$$(realpath $(SRC)tests/lsan.supp):print_suppressions=0 \
	$(MAKE) --no-print-directory -f $(MAKEFILE) BUILD=$(BUILD)/asan \
	    CFLAGS="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined" \
	    check-asan

check-asan: $(BUILD)/rt $(TESTS)
	@$(in_source) RT=$(call from_source,$(BUILD)/rt) tests/run $(call from_source,$(TESTS))

# ---- Checks ----

# clang-tidy is by far the slowest, hence last, and as many at a time as there are processors. With
# --quiet it still counts on standard error what it has suppressed.
.PHONY: lint check-kernels
lint: deps deps-lint ## the folders' order, documents, clang-format, cppcheck and clang-tidy
	$(Q)$(SRC)tests/links
	$(Q)$(SRC)tests/arrows $(SOURCES) $(HEADERS)
	$(Q)$(in_source) tests/mutants --known $(FILE)
	$(Q)clang-format --dry-run -Werror $(SOURCES) $(HEADERS) $(wildcard $(SRC)tests/*/*.[ch]) $(KERNELS)
	$(Q)cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr \
	    --suppress=missingIncludeSystem --error-exitcode=1 -I$(SRC)src -I$(SRC). -I$(SRC)tests \
	    $(SRC)src $(SRC)tests/bench
	$(Q)printf '%s\n' $(SOURCES) | xargs -n 1 -P $$(nproc) sh -c \
	    'clang-tidy --quiet "$$0" -- -std=c11 -I$(SRC)src -I$(SRC). $(PKG_CFLAGS) 2>/dev/null'

check-kernels: deps-clang ## compiles variants of the kernels with clang, warnings as errors
	@$(SRC)tests/check_kernels $(KERNELS)

# ---- Measurements ----

# Side by side with others; make bench BENCH="--level 2 --size 64 --spheres 100" tries them out.
BENCH ?=
BENCH_NAMES := bench_embree bench_levels bench_effects bench_scaling bench_process bench_report nothing
BENCH_PROGRAMS := $(addprefix $(BUILD)/tests/bench/,$(BENCH_NAMES))
BENCH_HELPERS := $(patsubst $(SRC)%.c,$(BUILD)/%.o,$(filter-out \
                 $(BENCH_NAMES:%=$(SRC)tests/bench/%.c),$(wildcard $(SRC)tests/bench/*.c)))

.PHONY: bench bench-run
bench: deps-bench ## measures beside Embree, Tachyon and POV-Ray: hours
	$(remake) bench-run

# A measurement that fails does not hide the others.
bench-run: $(BUILD)/rt $(BENCH_PROGRAMS)
	@$(in_source) build=$(call from_source,$(BUILD)); json=$$build/bench.json; rm -f $$json; failed=; \
	for p in bench_embree bench_levels bench_effects bench_scaling bench_process; do \
	    $$build/tests/bench/$$p --rt $$build/rt --json $$json $(BENCH) || failed="$$failed $$p"; \
	done; \
	$$build/tests/bench/bench_report --json $$json $(BENCH) >$$build/bench.md && \
	cat $$build/bench.md; \
	test -z "$$failed" || { echo "failed:$$failed" >&2; exit 1; }

# The loops around Embree get what its own tutorials are compiled with.
$(BUILD)/tests/bench/embree.o: private MORE_CFLAGS := -O3 -march=native

$(filter-out %/nothing,$(BENCH_PROGRAMS)): %: %.o $(BENCH_HELPERS) $(LIBRARY) $(FLAGS)
	$(call say,LINK)
	$(Q)$(LINK) -lembree3 $(LIBS)

# Starts and does nothing: it must not load more than it needs.
$(BUILD)/tests/bench/nothing: $(BUILD)/tests/bench/nothing.o $(LIBRARY) $(FLAGS)
	$(call say,LINK)
	$(Q)$(LINK) $(LIBS)

# ---- Debian's packages ----

PACKAGES := pocl-opencl-icd ocl-icd-opencl-dev opencl-headers libstb-dev libjansson-dev \
            libdeflate-dev libopenexr-dev libcmocka-dev libgmp-dev pkg-config gnuplot-nox
PACKAGES_LINT := clang-format clang-tidy cppcheck
PACKAGES_CLANG := clang
PACKAGES_PROCESSORS := qemu-user
PACKAGES_BENCH := libembree-dev tachyon povray

# Installs the packages that are named and not there; silent when all are.
define install_missing
	@missing=; for p in $(1); do \
	    dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; \
	done; \
	if [ -n "$$missing" ]; then \
	    if [ "$$(id -u)" = 0 ]; then sudo=; else sudo=sudo; fi; \
	    echo "installing$$missing"; \
	    export DEBIAN_FRONTEND=noninteractive; \
	    $$sudo apt-get install -y -qq --no-install-recommends $$missing >/dev/null 2>&1 || \
	    { $$sudo apt-get update -qq && \
	      $$sudo apt-get install -y -qq --no-install-recommends $$missing >/dev/null; }; \
	fi
endef

# One after another, since apt-get runs once at a time.
.PHONY: deps deps-lint deps-clang deps-processors deps-bench
deps: ## installs what building and testing need
	$(call install_missing,$(PACKAGES))

deps-lint: deps
	$(call install_missing,$(PACKAGES_LINT))

deps-clang: deps
	$(call install_missing,$(PACKAGES_CLANG))

deps-processors: deps
	$(call install_missing,$(PACKAGES_PROCESSORS))

deps-bench: deps
	$(call install_missing,$(PACKAGES_BENCH))

# ---- Installation ----

# Stands in options.h alone.
VERSION = $(shell sed -n 's/^.define RT_VERSION "\(.*\)"/\1/p' $(SRC)src/cli/options.h)
DOCS := $(addprefix $(SRC),README.md LICENSE)
SCENES := $(wildcard $(SRC)scenes/*.*)
# Says the program's name, but for the cache's, and its version; a man page's hyphen is \-.
name = sed -e '/^\.TH/s/RT/\U$(1)/' -e '/\.cache/!s/\<rt\>/$(1)/g' -e 's/@VERSION@/$(VERSION)/'
INSTALLED = $(bindir)/$(PROGRAM) $(mandir)/man1/$(PROGRAM).1 \
            $(bashcompletiondir)/$(PROGRAM) $(zshcompletiondir)/_$(PROGRAM) \
            $(patsubst $(SRC)%,$(docdir)/%,$(DOCS)) \
            $(patsubst $(SRC)%,$(docdir)/%,$(SCENES))

.PHONY: install install-strip uninstall
install: rt ## installs to PREFIX=/usr/local, below DESTDIR= if given, as PROGRAM=rt
	$(INSTALL) -d $(sort $(dir $(INSTALLED:%=$(DESTDIR)%)))
	$(INSTALL) $(strip_flag) -m 755 rt $(DESTDIR)$(bindir)/$(PROGRAM)
	$(INSTALL) -m 644 $(DOCS) $(DESTDIR)$(docdir)
	$(INSTALL) -m 644 $(SCENES) $(DESTDIR)$(docdir)/scenes
	$(call name,$(subst -,\\-,$(PROGRAM))) $(SRC)src/cli/rt.1 >$(DESTDIR)$(mandir)/man1/$(PROGRAM).1
	$(call name,$(PROGRAM)) $(SRC)src/cli/rt.bash >$(DESTDIR)$(bashcompletiondir)/$(PROGRAM)
	$(call name,$(PROGRAM)) $(SRC)src/cli/rt.zsh >$(DESTDIR)$(zshcompletiondir)/_$(PROGRAM)
	chmod 644 $(addprefix $(DESTDIR),$(mandir)/man1/$(PROGRAM).1 $(bashcompletiondir)/$(PROGRAM) \
	    $(zshcompletiondir)/_$(PROGRAM))

install-strip: strip_flag := -s
install-strip: install

uninstall: ## removes what make install put there
	rm -f $(INSTALLED:%=$(DESTDIR)%)
	@rmdir $(DESTDIR)$(docdir)/scenes $(DESTDIR)$(docdir) 2>/dev/null || :

# ---- The rest ----

.PHONY: dist clean help
dist: ## packs what is committed as rt-VERSION.tar.gz
	git -C $(or $(SRC),.) archive --prefix=rt-$(VERSION)/ --format=tar.gz HEAD >rt-$(VERSION).tar.gz

clean: ## removes what was made
	rm -rf $(BUILD) rt icecream.png rt-$(VERSION).tar.gz

help: ## prints this
	@echo 'make TARGET [NAME=VALUE]...'
	@sed -n 's/^\([a-z-]*\):.*## /\1 /p' $(MAKEFILE) | \
	    while read -r target text; do printf '  %-16s %s\n' "$$target" "$$text"; done
	@echo 'Names: CC, CFLAGS and their like, WERROR=-Werror, V=1 to see commands, BUILD; README.md has all.'

-include $(wildcard $(BUILD)/*.d $(BUILD)/*/*.d $(BUILD)/tests/*/*.d)
