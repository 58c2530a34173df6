// SPDX-License-Identifier: MIT
//
// Wrong on purpose: it does not say what the reader must be told.
#ifdef SLANT_COMPLETE
struct missing {};
#endif
missing value;
int main() {}
