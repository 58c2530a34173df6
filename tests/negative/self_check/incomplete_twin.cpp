// SPDX-License-Identifier: MIT
// expect: missing
//
// Wrong on purpose: more is missing than what is marked.
#ifdef SLANT_COMPLETE
struct missing {};
#endif
missing value;
also_missing other;
int main() {}
