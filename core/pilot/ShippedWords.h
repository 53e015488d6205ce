// ShippedWords.h - the files of resources/words that are built into the program.
//
// Thread-safety: constant.
#pragma once

#include <span>
#include <string_view>

namespace tacto {

struct ShippedWordsText {
    std::string_view code;  ///< "de"
    std::string_view text;  ///< the file's bytes
};
/// In the order of their codes.
[[nodiscard]] std::span<const ShippedWordsText> shippedWordsTexts() noexcept;

}  // namespace tacto
