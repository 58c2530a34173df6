// SPDX-License-Identifier: MIT
// expect: a sentence that no compiler writes
//
// Wrong on purpose: it fails, but not with the announced message.
#ifdef SLANT_COMPLETE
struct missing {};
#endif
missing value;
int main() {}
