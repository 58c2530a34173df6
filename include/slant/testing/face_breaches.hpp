// SPDX-License-Identifier: MIT
//
// The laws of faces, sampled; needs no test framework (face_laws.hpp does).
//
//     keep ∘ keep = keep,   ⟨keep x, y⟩ = ⟨x, keep y⟩,   keep x + keep_complement x = x,
//     y may be x, may hold NaN on entry; an infinite entry off the face is cut to 0, not to NaN;
//     block states are those of the enumeration.
#pragma once

#include <slant/concepts/face.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/testing/breach.hpp>

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace slant::testing {

/// The laws that a face breaks, with evidence; empty if none was seen to break. `prototype` is a
/// vector that it cuts down.
template <class F, vector V>
  requires block_partition<F, V>
[[nodiscard]] std::vector<breach> face_breaches(F const& face, V const& prototype) {
  using S = scalar_t<V>;
  index const n = slant::local(prototype).size();
  std::mt19937_64 generator(1);
  std::normal_distribution<double> gaussian;
  breach_log log;
  auto const blank = [&] {
    V v = slant::like(prototype, n);
    slant::local(v).setConstant(std::numeric_limits<S>::quiet_NaN());
    return v;
  };
  auto const random = [&] {
    V v = slant::like(prototype, n);
    for (index i = 0; i < n; ++i) slant::local(v).coeffRef(i) = S(gaussian(generator));
    return v;
  };
  auto const same = [&](V const& a, V const& b, std::string const& law) {
    for (index i = 0; i < n; ++i) {
      if (!(slant::local(a).coeff(i) == slant::local(b).coeff(i))) {
        log(law, "entry " + std::to_string(i));
        return;
      }
    }
  };

  V const x = random(), y = random();
  V kept = blank(), rest = blank(), kept_y = blank(), twice = blank();
  face.keep(x, kept);
  face.keep(y, kept_y);
  face.keep_complement(x, rest);
  face.keep(kept, twice);
  same(twice, kept, "keep twice is keep");
  V sum = kept;
  slant::local(sum) += slant::local(rest);
  same(sum, x, "keep and keep_complement add up to x");
  V in_place = x;
  face.keep(in_place, in_place);
  same(in_place, kept, "keep in place");
  in_place = x;
  face.keep_complement(in_place, in_place);
  same(in_place, rest, "keep_complement in place");
  // All products but those of entries that are kept in both vanish, exactly.
  if (!(slant::inner_product(kept, y) == slant::inner_product(kept, kept_y)) ||
      !(slant::inner_product(x, kept_y) == slant::inner_product(kept, kept_y))) {
    log("keep is self-adjoint", "the products differ");
  }

  V infinite = x;
  slant::local(infinite).setConstant(std::numeric_limits<S>::infinity());
  face.keep(infinite, kept_y);
  for (index i = 0; i < n; ++i) {
    bool const cut = slant::local(kept).coeff(i) == S(0);
    if (cut && !(slant::local(kept_y).coeff(i) == S(0))) {
      log("an infinite entry off the face is cut", "entry " + std::to_string(i));
    }
  }

  index counts[3] = {0, 0, 0};
  for (index i = 0; i < face.size(); ++i) {
    auto const s = static_cast<unsigned>(face.state(i));
    if (s < 3) ++counts[s];
  }
  if (counts[0] + counts[1] + counts[2] != face.size()) {
    log("every block is free, sliding or fixed", std::to_string(face.size()) + " blocks");
  }
  return log.found();
}

}  // namespace slant::testing
