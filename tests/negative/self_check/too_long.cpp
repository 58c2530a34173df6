// SPDX-License-Identifier: MIT
// expect: missing
// max-lines-gcc: 1
// max-lines-clang: 1
//
// Wrong on purpose: the message takes more than the one line allowed.
#ifdef SLANT_COMPLETE
struct missing {};
#endif
missing value;
int main() {}
