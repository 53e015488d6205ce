#include "core/pilot/ParticipantWords.h"

#include <algorithm>
#include <set>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/pilot/ShippedWords.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {

constexpr std::size_t kMaxText = 600;  // bytes: more does not fit a screen
constexpr const char *kLanguage = "language", *kVersion = "version", *kWords = "words";

/// Returns the places of a text: {"series", "of"} for "Series {series} of {of}".
std::set<std::string> placesIn(std::string_view text) {
    std::set<std::string> places;
    for (auto from = text.find('{'); from != std::string_view::npos; from = text.find('{', from + 1)) {
        const auto to = text.find('}', from);
        if (to == std::string_view::npos) return {std::string(text.substr(from))};
        places.emplace(text.substr(from + 1, to - from - 1));
    }
    return places;
}

std::string listOf(const std::set<std::string>& places) {
    std::string list;
    for (const auto& each : places) list += fmt::format("{}{{{}}}", list.empty() ? "" : " and ", each);
    return list.empty() ? "none" : list;
}

Result<std::string> textOfKey(const nlohmann::json& value, std::string_view where) {
    const auto* text = value.get_ptr<const std::string*>();
    if (text == nullptr || text->empty() || text->size() > kMaxText)
        return fail(ErrorCode::ParseError, "{} is {}; a text of 1 to {} bytes is expected", where,
                    text == nullptr ? dumpJson(value).substr(0, 40) : fmt::format("{} bytes long", text->size()),
                    kMaxText);
    const bool plain = std::ranges::none_of(*text, [](char c) { return static_cast<unsigned char>(c) < ' '; });
    if (!plain) return fail(ErrorCode::ParseError, "{} has a control character; one line of text is expected", where);
    return *text;
}

}  // namespace

Result<ParticipantWords> ParticipantWords::read(std::string_view text, std::string code, std::string_view source) {
    const auto json = parseJson(text, source);
    if (!json) return failure(json);
    if (auto known = onlyKeys(*json, {kLanguage, kVersion, kWords}, source); !known) return failure(known);
    ParticipantWords made;
    made.code_ = std::move(code);
    made.sha256_ = sha256Hex(text);
    for (const auto& [key, into] : {std::pair{kLanguage, &made.language_}, std::pair{kVersion, &made.version_}}) {
        auto value = textOfKey(valueOr(*json, key), fmt::format("{}: \"{}\"", source, key));
        if (!value) return failure(value);
        *into = std::move(*value);
    }
    const auto words = json->find(kWords);
    if (words == json->end() || !words->is_object())
        return fail(ErrorCode::ParseError, "{}: \"words\" is missing; an object of keys and texts is expected", source);
    for (const auto& [key, value] : words->items()) {
        auto read = textOfKey(value, fmt::format("{}: \"{}\"", source, key));
        if (!read) return failure(read);
        made.words_.emplace(key, std::move(*read));
    }
    return made;
}

const ParticipantWords& ParticipantWords::english() {
    static const ParticipantWords words = [] {
        const auto texts = shippedWordsTexts();
        const auto text = std::ranges::find(texts, "en", &ShippedWordsText::code)->text;
        auto made = read(text, "en", "en.json").value_or(ParticipantWords());  // tests/pilot/ParticipantWordsTest.cpp
        for (const auto& [key, value] : made.words_) made.order_.push_back(key);
        const auto placeOf = [text](const std::string& key) { return text.find('"' + key + "\":"); };
        std::ranges::sort(made.order_, {}, placeOf);
        return made;
    }();
    return words;
}

const std::vector<ParticipantWords>& ParticipantWords::builtIn() {
    static const std::vector<ParticipantWords> all = [] {
        std::vector<ParticipantWords> made{english()};
        for (const auto& each : shippedWordsTexts()) {
            if (each.code == "en") continue;
            if (auto words = parse(each.text, std::string(each.code), each.code)) made.push_back(std::move(*words));
        }
        return made;
    }();
    return all;
}

Result<ParticipantWords> ParticipantWords::parse(std::string_view text, std::string code, std::string_view source) {
    auto made = read(text, std::move(code), source);
    if (!made) return made;
    const auto& known = english().words_;
    for (const auto& [key, value] : made->words_) {
        const auto english = known.find(key);
        if (english == known.end())
            return fail(ErrorCode::ParseError, "{}: \"{}\" is no key of the words; those of en.json are expected",
                        source, key);
        const auto wanted = placesIn(english->second), found = placesIn(value);
        if (wanted != found)
            return fail(ErrorCode::ParseError, "{}: \"{}\" has the places {}; {} as in English are expected", source,
                        key, listOf(found), listOf(wanted));
    }
    for (const auto& key : english().order_) {
        if (!made->words_.contains(key))
            return fail(ErrorCode::ParseError, "{}: \"{}\" is missing; in English it is \"{}\"", source, key,
                        known.find(key)->second);
    }
    return made;
}

Result<std::vector<ParticipantWords>> ParticipantWords::in(const std::filesystem::path& folder) {
    std::vector<ParticipantWords> all;
    std::error_code error;
    if (!std::filesystem::exists(folder, error) && !error) return all;
    const auto files = documentsIn(folder);
    if (!files) return failure(files);
    for (const auto& file : *files) {
        const auto text = readTextFile(file, JsonLimits{}.bytes);
        if (!text) return failure(text);
        auto words = parse(*text, file.stem().string(), file.string());
        if (!words) return failure(words);
        all.push_back(std::move(*words));
    }
    return all;
}

std::string ParticipantWords::name() const {
    return fmt::format("{}, version {} ({:.12}…)", language_, version_, sha256_);
}

std::string ParticipantWords::text(std::string_view key, Places places) const {
    const auto found = words_.find(key);
    auto text = found == words_.end() ? std::string(key) : found->second;
    for (const auto& [place, value] : places) {
        const auto wanted = fmt::format("{{{}}}", place);
        for (auto at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + value.size()))
            text.replace(at, wanted.size(), value);
    }
    return text;
}

std::string ParticipantWords::text(std::string_view group, std::string_view item, std::string_view otherwise) const {
    const auto found = words_.find(fmt::format("{}.{}", group, item));
    return found == words_.end() ? std::string(otherwise) : found->second;
}

std::vector<std::pair<std::string, std::string>> ParticipantWords::all() const {
    std::vector<std::pair<std::string, std::string>> listed;
    for (const auto& key : english().order_) listed.emplace_back(key, text(key));
    return listed;
}

}  // namespace tacto
