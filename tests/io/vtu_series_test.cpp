// SPDX-License-Identifier: MIT
#include <slant/io/vtu.hpp>

#include <support/testing.hpp>
#include "io_support.hpp"

namespace vtu_series_test {

TEST_CASE("a list of numbered files with their times") {
  io_test::temporary_folder const folder;
  slant::vtu_series series(folder / "slip & stick.pvd");
  CHECK(series.next(0.5) == folder / "slip & stick_000.vtu");
  CHECK(series.next(2) == folder / "slip & stick_001.vtu");
  CHECK(series.size() == 2);
  series.write();
  CHECK(io_test::get(folder / "slip & stick.pvd") ==
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n <Collection>\n"
        "  <DataSet timestep=\"0.5\" part=\"0\" file=\"slip &amp; stick_000.vtu\"/>\n"
        "  <DataSet timestep=\"2\" part=\"0\" file=\"slip &amp; stick_001.vtu\"/>\n"
        " </Collection>\n</VTKFile>\n");
  CHECK(folder.entries() == 1);
}

TEST_CASE("names and times that make no series are refused") {
  CHECK(test::complaint([] { slant::vtu_series("out.vtu"); }) ==
        "list: got out.vtu, expected the name of a .pvd file");
  slant::vtu_series series("out.pvd");
  CHECK(test::complaint([&] { static_cast<void>(series.next(NAN)); }) ==
        "time: got nan, expected a finite number");
  static_cast<void>(series.next(1));
  CHECK(test::complaint([&] { static_cast<void>(series.next(1)); }) ==
        "time: got 1, expected a number greater than 1");
  CHECK(series.size() == 1);
}

}  // namespace vtu_series_test
