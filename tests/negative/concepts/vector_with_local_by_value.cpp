// SPDX-License-Identifier: MIT
// expect: 'local_is_lvalue['<]
// max-lines-gcc: 20
// max-lines-clang: 20
//
// A vector with foreign storage that makes a new view at each call instead of keeping one.
#include <slant/slant.hpp>

struct foreign {
  using view = Eigen::Map<Eigen::VectorXd>;
  std::vector<double> entries;
  view map{entries.data(), slant::index(entries.size())};

  explicit foreign(std::vector<double> e) : entries(std::move(e)) {}
  foreign(foreign const& other) : foreign(other.entries) {}
  foreign& operator=(foreign const& other) {
    entries = other.entries;
    new (&map) view(entries.data(), slant::index(entries.size()));
    return *this;
  }

#ifdef SLANT_COMPLETE
  view& local() { return map; }
  view const& local() const { return map; }
#else
  view local() { return map; }
  view local() const { return map; }
#endif
  double inner_product(foreign const& y) const { return map.dot(y.map); }
  foreign like(slant::index n) const { return foreign(std::vector<double>(std::size_t(n))); }
};

static_assert(slant::vector<foreign>);
