#include "core/seal/Passphrase.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fcntl.h>
#include <sodium.h>
#include <unistd.h>
#include <vector>
#include <zxcvbn.h>

#include "core/seal/SealedText.h"
#include "core/seal/Secret.h"

namespace tacto {

static_assert(Passphrase::kSaltBytes == crypto_pwhash_SALTBYTES);

PassphraseCost PassphraseCost::moderate() noexcept {
    return {crypto_pwhash_OPSLIMIT_MODERATE, crypto_pwhash_MEMLIMIT_MODERATE};
}
PassphraseCost PassphraseCost::least() noexcept { return {crypto_pwhash_OPSLIMIT_MIN, crypto_pwhash_MEMLIMIT_MIN}; }

Result<Passphrase> Passphrase::from(std::string_view text) {
    if (text.empty()) return invalid("the passphrase is empty; at least one character is expected");
    return Passphrase(Secret(std::as_bytes(std::span(text))));
}

Result<Passphrase> Passphrase::from(const Secret& text) {
    return from(std::string_view(reinterpret_cast<const char*>(text.bytes().data()), text.size()));
}

Result<Passphrase> Passphrase::fromFile(const std::filesystem::path& file) {
    constexpr std::size_t kLongest = 4096;
    // Read without a stream, because a stream's buffer would keep the passphrase.
    const int in = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (in < 0) return fail(ErrorCode::NotFound, "the passphrase file {} cannot be read", file.string());
    if (auto own = isOwnFile(in, file, "the passphrase file"); !own) {
        ::close(in);
        return failure(own);
    }
    Secret held(kLongest);
    auto* at = reinterpret_cast<char*>(held.bytes().data());
    std::size_t size = 0;
    while (size < kLongest) {
        const auto more = ::read(in, at + size, kLongest - size);
        if (more <= 0) break;
        size += static_cast<std::size_t>(more);
    }
    ::close(in);
    auto line = std::string_view(at, size);
    line = line.substr(0, line.find('\n'));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.size() == kLongest) {
        return fail(ErrorCode::NotFound, "the passphrase file {} holds {}; one line with the passphrase is expected",
                    file.string(), line.empty() ? "nothing in its first line" : "too long a line");
    }
    return from(line);
}

double Passphrase::strength_bits(std::string_view known) const {
    constexpr std::size_t kJudged =
        100;  // the beginning; a longer text only resists more, and would take long to judge
    constexpr std::string_view kSeparators = " \t.,:;-_/()";
    std::vector<std::string> words{"tactoscope"};
    for (std::size_t at = 0; (at = known.find_first_not_of(kSeparators, at)) != std::string_view::npos;) {
        const auto end = std::min(known.find_first_of(kSeparators, at), known.size());
        words.emplace_back(known.substr(at, end - at));
        at = end;
    }
    std::vector<const char*> dictionary;
    for (const auto& word : words) dictionary.push_back(word.c_str());
    dictionary.push_back(nullptr);
    Secret begins(kJudged + 1);  // ends with a zero
    std::memcpy(begins.bytes().data(), text_.bytes().data(), std::min(text_.size(), kJudged));
    return ZxcvbnMatch(reinterpret_cast<const char*>(begins.bytes().data()), dictionary.data(), nullptr);
}

Result<void> Passphrase::checkStrength(std::string_view known) const {
    const double bits = strength_bits(known);
    if (bits >= kMinStrength_bits) return {};
    return invalid(
        "the passphrase resists about {:.0f} bits of guessing; at least {:g} bits are expected, as of four words drawn "
        "at random",
        bits, kMinStrength_bits);
}

Result<Secret> Passphrase::keyFor(std::span<const std::byte> salt, const PassphraseCost& cost) const {
    Secret key(kKeyBytes);
    if (salt.size() != kSaltBytes || crypto_pwhash(reinterpret_cast<unsigned char*>(key.bytes().data()), key.size(),
                                                   reinterpret_cast<const char*>(text_.bytes().data()), text_.size(),
                                                   reinterpret_cast<const unsigned char*>(salt.data()), cost.passes(),
                                                   cost.bytes(), crypto_pwhash_ALG_ARGON2ID13) != 0) {
        return fail(ErrorCode::Io, "the passphrase cannot be turned into a key: {} MB of memory are needed",
                    cost.bytes() / 1'000'000);
    }
    return key;
}

}  // namespace tacto
