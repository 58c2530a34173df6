// SPDX-License-Identifier: MIT
//
// What MSSN, IMSSN and GIMSSN ask of their problem, and the answer to one that lacks something.
#pragma once

#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/modified_newton_options.hpp>
#include <slant/methods/modified_newton_state.hpp>

#include <type_traits>

namespace slant {

namespace detail {

template <class QP, class Inner, class Forcing>
using refused_modified_newton =
    refused_method<typename QP::vector_type, modified_newton_state<QP, Inner>,
                   modified_newton_options<typename QP::scalar, Forcing>>;

}  // namespace detail

/// A problem that lacks something ends here; see methods/detail/active_set_complaint.hpp. The
/// method itself is in modified_newton.hpp.
template <class QP, class Start, class Inner, class Forcing>
class modified_newton
    : public detail::refused_modified_newton<std::remove_cvref_t<QP>, Inner, Forcing> {
 public:
  using modified_newton::refused_method::refused_method;
};

/// No problem at all.
template <class QP, class Start, class Inner, class Forcing>
  requires(!quadratic_program<std::remove_cvref_t<QP>> &&
           !detail::was_refused<std::remove_cvref_t<QP>>)
class modified_newton<QP, Start, Inner, Forcing> : public detail::refused_method<void, void> {
 public:
  using modified_newton::refused_method::refused_method;
};

}  // namespace slant
