/* The scalar reference in float. */
#include "support/scalar_cases.h"
