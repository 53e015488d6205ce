// TakenAdvice.h - extracts the options that an error message advises, as a user would type them.
//
// Thread-safety: pure functions.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/LocaleFreeText.h"
#include "core/formats/CaptureFormat.h"

namespace tacto::test {

/// For "…; --time-column 1 reads it" returns {"--time-column", "1"}; HZ, which stands for a rate that only the user
/// knows, becomes 1000. Returns an empty list if the sentence advises nothing.
[[nodiscard]] inline std::vector<std::string> advisedWords(std::string_view sentence) {
    constexpr std::string_view kBegins[] = {"; --", ", --sample-rate "};
    std::size_t at = 0;
    for (const auto begins : kBegins) {
        const auto found = sentence.rfind(begins);
        if (found != std::string_view::npos) at = std::max(at, found + 2);
    }
    std::vector<std::string> words;
    const auto all = split(at == 0 ? std::string_view() : sentence.substr(at), ' ');
    for (std::size_t i = 0; i + 1 < all.size() && all[i].starts_with("--"); i += 2) {
        words.emplace_back(all[i]);
        words.emplace_back(all[i + 1] == "HZ" ? "1000" : all[i + 1]);
    }
    return words;
}

/// Returns `options` with `words` added, as the command line would read them.
[[nodiscard]] inline ReadOptions withAdvice(ReadOptions options, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
        const auto& option = words[i];
        const auto& value = words[i + 1];
        if (option == "--format") options.format = value;
        if (option == "--skip-rows") options.skipRows = static_cast<std::size_t>(parseNumber(value).value());
        if (option == "--time-column") options.timeColumn = value;
        if (option == "--sample-rate") options.rate = Hertz(parseNumber(value).value());
        if (option == "--unit") options.units[value.substr(0, value.find('='))] = value.substr(value.find('=') + 1);
        if (option == "--columns") {
            options.columns.clear();
            for (const auto name : split(value, ',')) options.columns.emplace_back(name);
        }
    }
    return options;
}

}  // namespace tacto::test
