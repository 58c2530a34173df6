// SPDX-License-Identifier: MIT
//
// The entry point of every test executable; compiled once and shared by all rooms.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
