// GivenOnce.h - what may be given once: a key, an option, a name. How a second one is found, and the sentence that
// refuses it.
//
// Thread-safety: pure functions.
#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace tacto {

/// The first of `values` whose projection is equal to that of one before it. Null when all differ.
template <class Values, class Projection = std::identity>
[[nodiscard]] constexpr auto secondIn(const Values& values, Projection projection = {}) -> decltype(&*values.begin()) {
    for (auto at = std::begin(values); at != std::end(values); ++at) {
        if (std::ranges::find(std::begin(values), at, std::invoke(projection, *at), projection) != at) return &*at;
    }
    return nullptr;
}

/// `the tag "a" is given twice; once is expected`: `text` with `args` names what is.
template <class... Args>
[[nodiscard]] std::string givenTwice(fmt::format_string<Args...> text, Args&&... args) {
    return fmt::format(text, std::forward<Args>(args)...) + " is given twice; once is expected";
}

}  // namespace tacto
