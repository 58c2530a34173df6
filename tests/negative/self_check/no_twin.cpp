// SPDX-License-Identifier: MIT
// expect: missing
//
// Wrong on purpose: there is no complete twin.
missing value;
int main() {}
