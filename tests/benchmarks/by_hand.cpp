// SPDX-License-Identifier: GPL-3.0-or-later
#include "benchmarks/by_hand.hpp"

namespace by_hand {

template class Chain<1>;
template class Chain<2>;
template class Chain<3>;
template class Chain<5>;
template class Chain<8>;
template class Chain<12>;
template class Chain<20>;
template class Chain<30>;

}  // namespace by_hand
