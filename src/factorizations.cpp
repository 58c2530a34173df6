// SPDX-License-Identifier: MIT
#include <slant/factorizations/dense_ldlt.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant {

template class dense_ldlt<double>;
template class dense_ldlt<float>;

}  // namespace slant
