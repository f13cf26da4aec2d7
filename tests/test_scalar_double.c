/* The scalar reference in double. */
#define RT_SCALAR_DOUBLE
#include "scalar_cases.h"
