// SPDX-License-Identifier: MIT
//
// What is seen of a sequence of load steps: a table with a line for each, a series of files for
// ParaView, and a picture of the slip zone over time.
#pragma once

#include <cmath>
#include <cstdio>
#include <fem/contact_field.hpp>
#include <fem/contact_vtu.hpp>
#include <fem/plots/slip_history_plot.hpp>
#include <optional>
#include <slant/io/vtu.hpp>
#include <string>
#include <support/text_table.hpp>
#include <vector>

#include "methods.hpp"

namespace coulomb {

/// The coefficient in the direction of t: that of the ellipse with the semi-axes F¹, F².
template <int D>
[[nodiscard]] double coefficient_along(Eigen::Matrix<double, D - 1, 1> const& t, double first,
                                       double second) {
  if constexpr (D == 3) {
    if (first != second && t.norm() > 0)
      return first * second * t.norm() / std::hypot(second * t[0], first * t[1]);
  }
  return first;
}

template <int D>
class history {
 public:
  /// Refers to its arguments.
  history(settings const& s, loaded_scene<D> const& loaded, friction const& F)
      : settings_(&s),
        loaded_(&loaded),
        friction_(&F),
        position_(Eigen::VectorXd::Zero(loaded.scene.T.rows())),
        pressed_(position_) {
    if (!s.output.empty()) series_.emplace(s.output / "coulomb.pvd");
    table_.print_head();
  }

  /// T u of the last step.
  [[nodiscard]] Eigen::VectorXd const& position() const { return position_; }

  /// A step that has converged, number i, with its displacements.
  void record(int i, load_share const& share, step_result const& step, Eigen::VectorXd const& u) {
    auto const& scene = loaded_->scene;
    Eigen::Index const m = scene.contact_count();
    Eigen::VectorXd bound(m);
    for (Eigen::Index j = 0; j < m; ++j) {
      bound[j] = std::fmax(step.λ[j], 0) *
                 coefficient_along<D>(step.λ.template segment<D - 1>(m + (D - 1) * j),
                                      friction_->along[j], friction_->across[j]);
    }
    field_ = fem::make_contact_field<D>(scene, {bound, position_}, u, step.λ.head(m),
                                        step.λ.tail((D - 1) * m));
    double const time = static_cast<double>(i) / settings_->steps;
    records_.push_back({time, field_.state});
    if (series_) fem::write_contact_vtu(series_->next(time), scene, field_, u);
    position_ = scene.T * u;
    if (i == settings_->steps) pressed_ = position_;
    print(i, share, step,
          {std::to_string(field_.count(fem::contact_state::open)),
           std::to_string(field_.count(fem::contact_state::stick)),
           std::to_string(field_.count(fem::contact_state::slip))});
  }
  /// One that has not: nothing is known of its contacts.
  void record_failure(int i, load_share const& share, step_result const& step) {
    print(i, share, step, {"-", "-", "-"});
  }

  /// The summary and the files.
  void finish() {
    std::printf("\n  products       %td in all; K was factored once\n", products_);
    if (records_.empty()) return;
    // The loads of the last step are those before the drag: without friction nothing would be left.
    std::printf("  left behind    by the drag: slip of %.3g at most; friction of %.3g %s at most\n",
                (position_ - pressed_).cwiseAbs().maxCoeff(),
                field_.friction.colwise().norm().maxCoeff(), loaded_->stress_unit.data());
    if (!series_) return;
    series_->write();
    std::printf("\nwrote %s\n", (settings_->output / "coulomb.pvd").c_str());
    auto const plot =
        fem::slip_history_plot(settings_->output / "slip.png", field_, records_,
                               loaded_->title + ": pressed (1), dragged (2), released (3)");
    std::printf("%s\n", plot.message.c_str());
  }

 private:
  void print(int i, load_share const& share, step_result const& step,
             std::vector<std::string> const& contacts) {
    auto const decimal = [](double x) {
      char text[32];
      std::snprintf(text, sizeof text, "%.3f", x);
      return std::string(text);
    };
    products_ += step.products;
    table_.print_row({std::to_string(i), decimal(share.press), decimal(share.drag), contacts[0],
                      contacts[1], contacts[2], std::to_string(step.products),
                      std::to_string(step.steps), step.method,
                      std::string(slant::to_string(step.status))});
  }

  settings const* settings_;
  loaded_scene<D> const* loaded_;
  friction const* friction_;
  examples::text_table table_{
      {"step", "press", "drag", "open", "stick", "slip", "products", "steps", "by", "status"}, 6};
  std::optional<slant::vtu_series> series_{};
  std::vector<fem::slip_record> records_{};
  fem::contact_field<D> field_{};
  Eigen::VectorXd position_;
  Eigen::VectorXd pressed_;  // T u before the drag
  slant::index products_ = 0;
};

}  // namespace coulomb
