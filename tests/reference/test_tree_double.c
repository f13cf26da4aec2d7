/* The scalar reference in double. */
#define RT_SCALAR_DOUBLE
#include "support/scalar_cases.h"
