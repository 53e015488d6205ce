// ParticipantWords.h - all that a participant reads, in one language. The words are a file (resources/words/en.json):
// {"language", "version", "words": {key: text}}, named after the language. The English file states the keys and, in
// braces, the places for names and numbers; another file has the same keys with the same places.
//
// Thread-safety: constant values.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

class ParticipantWords {
public:
    /// The words that are built in: English, and all of resources/words.
    [[nodiscard]] static const ParticipantWords& english();
    [[nodiscard]] static const std::vector<ParticipantWords>& builtIn();
    /// `code`: the language, as the file is named; `source` begins each message. Errors: ParseError in one sentence
    /// for a text that is no such file, a key that is missing or not known, an empty or overlong text, and other places
    /// than in English.
    [[nodiscard]] static Result<ParticipantWords> parse(std::string_view text, std::string code,
                                                        std::string_view source);
    /// Reads FOLDER/*.json; a folder that does not exist has none. Errors: Io; as parse().
    [[nodiscard]] static Result<std::vector<ParticipantWords>> in(const std::filesystem::path& folder);

    [[nodiscard]] const std::string& code() const noexcept { return code_; }          ///< "de"
    [[nodiscard]] const std::string& language() const noexcept { return language_; }  ///< "Deutsch"
    [[nodiscard]] const std::string& version() const noexcept { return version_; }
    [[nodiscard]] const std::string& sha256() const noexcept { return sha256_; }  ///< of the file's bytes
    /// Returns "Deutsch, version 1 (0123456789ab…)".
    [[nodiscard]] std::string name() const;

    using Places = std::initializer_list<std::pair<std::string_view, std::string>>;
    /// Returns the text of `key` with its places filled; `key` itself where there is no such text.
    [[nodiscard]] std::string text(std::string_view key, Places places = {}) const;
    /// As text("GROUP.ITEM"); `otherwise` where there is no such text.
    [[nodiscard]] std::string text(std::string_view group, std::string_view item, std::string_view otherwise) const;
    /// All keys and texts in the order of the English file, as for a committee.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> all() const;

private:
    [[nodiscard]] static Result<ParticipantWords> read(std::string_view text, std::string code,
                                                       std::string_view source);

    std::string code_, language_, version_, sha256_;
    std::map<std::string, std::string, std::less<>> words_;
    std::vector<std::string> order_;  // keys, only in English
};

}  // namespace tacto
