#include "tests/fuzz/Mutation.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace tacto::fuzz {
namespace {

/// Values at the ends of ranges: 0, 1, the largest signed and unsigned, a ScienceMode frame's start and stuffing byte.
constexpr std::array<std::uint8_t, 10> kTelling{0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF, 0xF0, 0x0F, 0x81, 0x55};

enum class Change { Flip, Replace, Insert, Delete, Truncate, Repeat, Splice, Count };

std::ptrdiff_t at(std::size_t index) noexcept { return static_cast<std::ptrdiff_t>(index); }

/// Returns a position from 0 to `size`, including both.
std::size_t place(std::size_t size, Random& random) noexcept { return random.below(size + 1); }

std::uint8_t anyByte(Random& random) noexcept {
    if (random.below(2) == 0) return kTelling[random.below(kTelling.size())];
    return static_cast<std::uint8_t>(random.below(256));
}

void insert(Bytes& input, const std::vector<Bytes>& dictionary, Random& random) {
    Bytes added(1 + random.below(8));
    for (auto& byte : added) byte = anyByte(random);
    if (!dictionary.empty() && random.below(2) == 0) added = dictionary[random.below(dictionary.size())];
    input.insert(input.begin() + at(place(input.size(), random)), added.begin(), added.end());
}

void repeat(Bytes& input, Random& random) {
    const auto from = random.below(input.size());
    const auto length = std::min<std::size_t>(1 + random.below(32), input.size() - from);
    const Bytes part(input.begin() + at(from), input.begin() + at(from + length));
    for (auto times = 1 + random.below(8); times > 0; --times) {
        input.insert(input.begin() + at(from), part.begin(), part.end());
    }
}

void splice(Bytes& input, const Bytes& other, Random& random) {
    input.resize(place(input.size(), random));
    input.insert(input.end(), other.begin() + at(place(other.size(), random)), other.end());
}

void change(Bytes& input, const std::vector<Bytes>& corpus, const std::vector<Bytes>& dictionary, Random& random) {
    const auto kind = static_cast<Change>(random.below(static_cast<std::uint64_t>(Change::Count)));
    if (kind == Change::Splice) return splice(input, corpus[random.below(corpus.size())], random);
    if (kind == Change::Insert || input.empty()) return insert(input, dictionary, random);
    const auto where = random.below(input.size());
    if (kind == Change::Flip) input[where] ^= static_cast<std::uint8_t>(1U << random.below(8));
    if (kind == Change::Replace) input[where] = anyByte(random);
    if (kind == Change::Truncate) input.resize(where);
    if (kind == Change::Repeat) repeat(input, random);
    if (kind == Change::Delete) {
        const auto length = std::min<std::size_t>(1 + random.below(8), input.size() - where);
        input.erase(input.begin() + at(where), input.begin() + at(where + length));
    }
}

/// Returns the word between the quotes of a line, or nothing.
std::optional<Bytes> wordOf(std::string_view line) {
    const auto begin = line.find('"');
    const auto end = line.rfind('"');
    if (begin == std::string_view::npos || end == begin) return std::nullopt;
    const auto text = line.substr(begin + 1, end - begin - 1);
    Bytes word;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            word.push_back(static_cast<std::uint8_t>(text[i]));
            continue;
        }
        const auto escaped = text.substr(i + 1);
        if (escaped.starts_with('\\') || escaped.starts_with('"')) {
            word.push_back(static_cast<std::uint8_t>(text[++i]));
            continue;
        }
        std::uint8_t byte = 0;
        if (!escaped.starts_with('x') || escaped.size() < 3 ||
            std::from_chars(escaped.data() + 1, escaped.data() + 3, byte, 16).ptr != escaped.data() + 3) {
            return std::nullopt;
        }
        word.push_back(byte);
        i += 3;
    }
    if (word.empty()) return std::nullopt;
    return word;
}

}  // namespace

std::optional<std::vector<Bytes>> dictionaryFrom(std::string_view text) {
    std::vector<Bytes> words;
    while (!text.empty()) {
        const auto end = text.find('\n');
        const auto line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line.starts_with('#')) continue;
        auto word = wordOf(line);
        if (!word) return std::nullopt;
        words.push_back(*std::move(word));
    }
    return words;
}

Bytes mutated(const std::vector<Bytes>& corpus, const std::vector<Bytes>& dictionary, Random& random) {
    Bytes input = corpus[random.below(corpus.size())];
    for (auto changes = 1 + random.below(8); changes > 0; --changes) change(input, corpus, dictionary, random);
    if (input.size() > kMaxFile) input.resize(kMaxFile);
    return input;
}

}  // namespace tacto::fuzz
