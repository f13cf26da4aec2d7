/* Kernels that are wrong on purpose, so that tests can show what they notice. */
#ifndef RT_TESTS_SUPPORT_MUTANTS_H
#define RT_TESTS_SUPPORT_MUTANTS_H

#include <stddef.h>

/* MUTANT_..., by the names in mutants.def. */
typedef enum test_mutant {
    MUTANT_NONE,
#define MUTANT(name, file, what, from, to) MUTANT_##name,
#include "support/mutants.def"
#undef MUTANT
    MUTANT_COUNT
} test_mutant;

typedef struct test_mutation {
    const char *name;      /* MUTANT_..., as tests call it */
    const char *file;      /* below kernels/ */
    const char *what;      /* is wrong, in a few words */
    const char *from, *to; /* the text that is replaced, once in the file, and its replacement */
} test_mutation;

/* By mutant; nothing but NULL for MUTANT_NONE. */
extern const test_mutation test_mutations[MUTANT_COUNT];

/* Copies the kernels, those of RT_KERNELS where that is set, to a fresh folder with that change and
 * makes RT_KERNELS name it until test_restore_kernels. */
void test_mutate_kernels(test_mutant mutant);
/* RT_KERNELS as it was. */
void test_restore_kernels(void);

#endif
