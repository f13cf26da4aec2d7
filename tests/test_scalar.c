/* The scalar reference in float. */
#include "scalar_cases.h"
