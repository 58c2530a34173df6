// SPDX-License-Identifier: MIT
// expect: anything
//
// Wrong on purpose: nothing needs what is marked as missing.
#ifdef SLANT_COMPLETE
struct not_needed {};
#endif
int main() {}
