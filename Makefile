# rt: a ray tracer in C11 and OpenCL C. README.md says what each target is for.

PREFIX ?= /usr/local
DESTDIR ?=
CC ?= cc
CFLAGS ?= -O2 -g
# Empty for compilers whose warnings nobody here has seen: make WERROR=
WERROR ?= -Werror
# build/ holds everything that is made except ./rt; make asan keeps its own.
BUILD ?= build

# make V=1 shows whole commands.
Q := $(if $(V),,@)
say = @$(if $(V),:,printf '  %-6s %s\n' $(1)) $@

PACKAGES := pocl-opencl-icd ocl-icd-opencl-dev opencl-headers libstb-dev libjansson-dev \
            libdeflate-dev libcmocka-dev libgmp-dev pkg-config
PACKAGES_LINT := clang-format clang-tidy cppcheck
PACKAGES_CLANG := clang
PACKAGES_BENCH := libembree-dev tachyon povray
LIBRARIES := OpenCL jansson libdeflate
# In the order in which program.c and check-kernels put them together.
KERNELS := $(addprefix kernels/,options.h types.h \
           $(addprefix lib/,real.h vec3.cl sampling.cl tile.cl) \
           $(addprefix primitives/,intersect.cl sphere.cl watertight.cl) \
           $(addprefix traversal/,packet.cl traverse.cl) \
           $(addprefix shading/,surface.cl pattern.cl) \
           $(addprefix stages/,camera.cl trace.cl probe.cl path.cl shade.cl queue.cl resolve.cl))

WARNINGS := -Wall -Wextra -Wshadow -Wconversion $(WERROR)
# No contraction: a multiply-add is fused where the code says fma, and nowhere else.
override CFLAGS += -std=c11 -pthread -Isrc -I. -ffp-contract=off $(WARNINGS) -MMD -MP
# Asked only when something is compiled, since `make demo` installs pkg-config first.
PKG_CFLAGS = $(shell pkg-config --cflags $(LIBRARIES) stb cmocka)
PKG_LIBS = $(shell pkg-config --libs $(LIBRARIES))

SOURCES := $(wildcard src/*.c src/*/*.c)
# The scalar reference is compiled twice, for float and for double; stb's code is compiled as it is.
OBJECTS := $(patsubst src/%.c,$(BUILD)/%.o,$(SOURCES)) $(BUILD)/opencl/kernel_text.o \
           $(patsubst src/%.c,$(BUILD)/%_double.o,$(wildcard src/reference/*.c))
LIBRARY := $(filter-out $(BUILD)/main.o,$(OBJECTS))
TESTS := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/*/test_*.c))
TEST_HELPERS := $(patsubst %.c,$(BUILD)/%.o,tests/support/support.c \
                $(filter-out tests/hard/test_%,$(wildcard tests/hard/*.c)))

.PHONY: all demo test check lint asan check-kernels deps deps-lint deps-clang install uninstall clean
.DELETE_ON_ERROR:
.SECONDARY:

all: rt

rt: $(BUILD)/rt
	@cp $< $@

$(BUILD)/rt: $(OBJECTS)
	$(call say,LINK)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(PKG_LIBS) -lm

$(BUILD)/%.o: src/%.c
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(PKG_CFLAGS) -c -o $@ $<

# Its JPEG code shifts into the sign bit; that is the library's, and harmless. Its loops over a
# picture's bytes are vectorised at -O3 only.
$(BUILD)/image/stb_write.o $(BUILD)/image/stb_read.o: override CFLAGS += -O3 -fno-sanitize=undefined

$(BUILD)/%_double.o: src/%.c
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) -DRT_SCALAR_DOUBLE -c -o $@ $<

$(BUILD)/opencl/kernel_text.o: $(BUILD)/opencl/kernel_text.c
	$(call say,CC)
	$(Q)$(CC) $(CFLAGS) -c -o $@ $<

$(BUILD)/opencl/kernel_text.c: src/opencl/kernel_text.awk $(KERNELS)
	$(call say,GEN)
	@mkdir -p $(@D)
	$(Q)awk -f $< $(KERNELS) >$@

# Two commands on a fresh machine: both install what is missing and say nothing when nothing is.
demo: deps
	@$(MAKE) --no-print-directory rt
	./rt scenes/icecream.txt icecream.png

test: deps
	@$(MAKE) --no-print-directory check

check: rt $(TESTS)
	@RT=./rt tests/run $(TESTS)

# The hard cases with ten times the rays: minutes.
.PHONY: test-hard check-hard
test-hard: deps
	@$(MAKE) --no-print-directory check-hard

check-hard: rt $(filter $(BUILD)/tests/hard/%,$(TESTS))
	@RT=./rt RT_HARD_RAYS=$${RT_HARD_RAYS:-10000000} RT_HARD_TABLE=$(BUILD)/hard.md \
	    tests/run $(filter $(BUILD)/tests/hard/%,$(TESTS))

$(BUILD)/tests/%.o: tests/%.c
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(PKG_CFLAGS) $(TEST_CFLAGS) -Itests -c -o $@ $<

# The loops around Embree get what its own tutorials are compiled with.
$(BUILD)/tests/bench/embree.o: TEST_CFLAGS := -O3 -march=native

$(TESTS): $(BUILD)/%: %.c $(TEST_HELPERS) $(LIBRARY)
	$(call say,CC)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(PKG_CFLAGS) -Itests $(LDFLAGS) -o $@ $(filter %.c %.o,$^) $(PKG_LIBS) -lcmocka -lgmp -lm

# On PoCL alone, whose leaks are known: what other drivers keep is not ours either.
# LLVM, in the thread that opens devices, sets a signal stack of its own, which the sanitizer would
# take for its own.
asan: deps
	@OCL_ICD_VENDORS=$${OCL_ICD_VENDORS:-$$(ls /etc/OpenCL/vendors/pocl.icd 2>/dev/null)} \
	ASAN_OPTIONS=detect_leaks=1:use_sigaltstack=0 LSAN_OPTIONS=suppressions=$(CURDIR)/tests/lsan.supp:print_suppressions=0 \
	$(MAKE) --no-print-directory BUILD=build/asan \
	    CFLAGS="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined" \
	    check-asan

.PHONY: check-asan
check-asan: $(BUILD)/rt $(TESTS)
	@RT=$(BUILD)/rt tests/run $(TESTS)

lint: deps deps-lint
	tests/arrows $(SOURCES) $(wildcard src/*/*.h)
	clang-format --dry-run -Werror $(SOURCES) $(wildcard src/*/*.h tests/*/*.[ch]) $(KERNELS)
	cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr \
	    --suppress=missingIncludeSystem --error-exitcode=1 -Isrc -I. -Itests src tests/bench
	clang-tidy --quiet $(SOURCES) -- -std=c11 -Isrc -I. $(PKG_CFLAGS) 2>/dev/null

check-kernels: deps-clang
	@tests/check_kernels $(KERNELS)

# Side-by-side measurements; make bench BENCH="--level 2 --size 64 --spheres 100" tries them out.
BENCH ?=
BENCH_JSON := $(BUILD)/bench.json
BENCH_NAMES := bench_embree bench_levels bench_effects bench_scaling bench_process bench_report nothing
BENCH_PROGRAMS := $(addprefix $(BUILD)/tests/bench/,$(BENCH_NAMES))
BENCH_HELPERS := $(patsubst %.c,$(BUILD)/%.o,$(filter-out \
                 $(BENCH_NAMES:%=tests/bench/%.c),$(wildcard tests/bench/*.c)))

.PHONY: bench bench-run bench-deps
bench: deps bench-deps
	@$(MAKE) --no-print-directory bench-run

# A measurement that fails does not hide the others.
bench-run: $(BUILD)/rt $(BENCH_PROGRAMS)
	@rm -f $(BENCH_JSON); failed=; for p in bench_embree bench_levels bench_effects bench_scaling bench_process; do \
	    $(BUILD)/tests/bench/$$p --rt $(BUILD)/rt --json $(BENCH_JSON) $(BENCH) || failed="$$failed $$p"; \
	done; \
	$(BUILD)/tests/bench/bench_report --json $(BENCH_JSON) $(BENCH) >$(BUILD)/bench.md && \
	cat $(BUILD)/bench.md; \
	test -z "$$failed" || { echo "failed:$$failed" >&2; exit 1; }

$(filter-out %/nothing,$(BENCH_PROGRAMS)): %: %.o $(BENCH_HELPERS) $(LIBRARY)
	$(call say,LINK)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(PKG_LIBS) -lembree3 -lm

# Starts and does nothing: it must not load more than it needs.
$(BUILD)/tests/bench/nothing: $(BUILD)/tests/bench/nothing.o $(LIBRARY)
	$(call say,LINK)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(PKG_LIBS) -lm

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

deps:
	$(call install_missing,$(PACKAGES))

deps-lint:
	$(call install_missing,$(PACKAGES_LINT))

deps-clang:
	$(call install_missing,$(PACKAGES_CLANG))

bench-deps:
	$(call install_missing,$(PACKAGES_BENCH))

install: rt
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/man/man1
	install -m 755 rt $(DESTDIR)$(PREFIX)/bin/rt
	install -m 644 src/cli/rt.1 $(DESTDIR)$(PREFIX)/share/man/man1/rt.1

uninstall:
	rm -f $(DESTDIR)$(PREFIX)/bin/rt $(DESTDIR)$(PREFIX)/share/man/man1/rt.1

clean:
	rm -rf build rt icecream.png

-include $(wildcard $(BUILD)/*.d $(BUILD)/*/*.d $(BUILD)/tests/*/*.d)
