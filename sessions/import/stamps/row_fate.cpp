#include "sessions/import/stamps/row_fate.h"

namespace herr {
namespace {

// In the order of RowFate.
constexpr std::array<RowFateText, kRowFates> kTexts{{
    {"lost_tracking", "rows left out: without tracking", true},
    {"wild_stamp", "rows left out: the stamp is far from its neighbours", true},
    {"other_clock", "rows left out: of another clock than the rows that stay (it was reset, or jumped)",
     true},
    {"backward_stamp", "rows left out: the stamp goes backwards (--sort puts late ones in place)", true},
    {"repeated_stamp", "rows left out: the stamp repeats the one before", true},
    {"bad", "rows left out: not readable", true},
    {"thinned", "rows left out: a second camera's stamp beside the first one's", false},
}};

}  // namespace

std::span<const RowFateText, kRowFates> row_fate_texts() {
  return kTexts;
}

}  // namespace herr
