// What the program says to its users has no words of its makers: sentences of windows, errors, refusals and reports.
#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <regex>
#include <set>

#include "tests/support/Support.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

struct Said {
    std::string text;
    std::size_t line;
    std::vector<std::string> within;  ///< the calls around it: "tr", "fail"
};

/// The string literals of a C++ source, with neighbours joined as the compiler joins them.
class Literals {
public:
    explicit Literals(const std::string& source) : source_(source) {}

    std::vector<Said> all() {
        while (at_ < source_.size()) step();
        return std::move(found_);
    }

private:
    [[nodiscard]] bool sees(const char* what) const { return source_.compare(at_, std::strlen(what), what) == 0; }
    void skipTo(const std::string& end) {
        const auto found = source_.find(end, at_);
        const auto next = found == std::string::npos ? source_.size() : found + end.size();
        line_ += static_cast<std::size_t>(std::count(source_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                     source_.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
        at_ = next;
    }
    void step() {
        const char c = source_[at_];
        if (sees("//")) return skipTo("\n");
        if (sees("/*")) return skipTo("*/");
        if (sees("R\"") && !isWord(before())) return raw();
        if (c == '"') return text();
        if (c == '\'' && !isWord(before())) return character();
        if (c == '\n') ++line_;
        if (c == '(') {
            calls_.push_back(word_);
        } else if (c == ')' && !calls_.empty()) {
            calls_.pop_back();
        }
        if (!std::isspace(static_cast<unsigned char>(c))) {
            joins_ = false;
            if (!isWord(c) || !isWord(before())) word_.clear();
            if (isWord(c)) word_ += c;
        }
        ++at_;
    }
    [[nodiscard]] char before() const { return at_ == 0 ? ' ' : source_[at_ - 1]; }
    static bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
    void add(const std::string& text, std::size_t line) {
        if (joins_) {
            found_.back().text += text;
        } else {
            found_.push_back({text, line, calls_});
        }
        joins_ = true;
        word_.clear();
    }
    void text() {
        const auto line = line_;
        std::string said;
        for (++at_; at_ < source_.size() && source_[at_] != '"'; ++at_) {
            if (source_[at_] == '\\') ++at_;
            if (at_ < source_.size()) said += source_[at_];
        }
        ++at_;
        add(said, line);
    }
    void raw() {
        const auto line = line_;
        const auto open = source_.find('(', at_);
        const auto end = ")" + source_.substr(at_ + 2, open - at_ - 2) + "\"";
        const auto close = source_.find(end, open);
        add(source_.substr(open + 1, close - open - 1), line);
        skipTo(end);
    }
    void character() {
        for (++at_; at_ < source_.size() && source_[at_] != '\''; ++at_)
            if (source_[at_] == '\\') ++at_;
        ++at_;
    }

    const std::string& source_;
    std::size_t at_ = 0, line_ = 1;
    std::string word_;
    bool joins_ = false;
    std::vector<std::string> calls_;
    std::vector<Said> found_;
};

/// "gate: the gate refuses it" of a sentence; empty where it has no such word.
std::string jargonIn(const std::string& sentence) {
    // A regular expression for each of some thousand sentences takes seconds.
    const auto has = [&](const char* part) { return strcasestr(sentence.c_str(), part) != nullptr; };
    if (!has("gate") && !has("epoch") && !has("interlock")) return "";
    static const std::regex words(R"(\b(gates?|epochs?|interlocks?)\b)", std::regex::icase);
    std::smatch found;
    return std::regex_search(sentence, found, words) ? found[1].str() + ": " + sentence : "";
}

/// Whether users read it: it is handed to one of these, or is a sentence in a report.
bool isSaidToUsers(const fs::path& file, const Said& said) {
    static const std::set<std::string> speaks{"tr", "translate", "fail", "refused"};
    if (std::ranges::any_of(said.within, [](const auto& call) { return speaks.contains(call); })) return true;
    return file.string().starts_with("app/report/") && said.text.find(' ') != std::string::npos;
}

TEST(Language, SaysNothingInTheMakersWords) {
    std::size_t sentences = 0;
    for (const char* top : {"app", "core", "drivers"}) {
        for (const auto& entry : fs::recursive_directory_iterator(test::sourceDir() / top)) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
            const auto file = fs::relative(entry.path(), test::sourceDir());
            std::ifstream in(entry.path(), std::ios::binary);
            const std::string source{std::istreambuf_iterator<char>(in), {}};
            for (const auto& said : Literals(source).all()) {
                if (!isSaidToUsers(file, said)) continue;
                ++sentences;
                EXPECT_EQ(jargonIn(said.text), "") << file.string() << ":" << said.line;
            }
        }
    }
    EXPECT_GT(sentences, 2000U);
}

TEST(Language, SentencesAreFoundInSources) {
    const std::string source =
        "// \"no\"\n/* \"no\" */ x = tr(\"one \\\"two\\\"\"\n  \" three\"); f('\"', g(fail(kA, R\"(raw "
        "\"x\")\")));\n\"last\";";
    const auto found = Literals(source).all();
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].text, "one \"two\" three");
    EXPECT_EQ(found[0].line, 2U);
    EXPECT_EQ(found[1].text, "raw \"x\"");
    EXPECT_EQ(found[1].within, (std::vector<std::string>{"f", "g", "fail"}));
    EXPECT_TRUE(isSaidToUsers("core/x.cpp", found[1]));
    EXPECT_FALSE(isSaidToUsers("core/x.cpp", found[2]));
    EXPECT_EQ(jargonIn("an aggregate, epochal"), "");
    EXPECT_EQ(jargonIn("The Gate refuses"), "Gate: The Gate refuses");
}

/// "is no file" in a line; empty where a comparison follows ("is no longer than") or "there" stands before.
std::string misplacedNoIn(const std::string& line) {
    static const std::set<std::string> rightful{"longer",   "more",    "less",   "later",  "earlier", "better", "worse",
                                                "larger",   "smaller", "higher", "lower",  "faster",  "slower", "wider",
                                                "narrower", "use",     "such",   "reason", "other"};
    static const std::regex words(R"((?:(\w+)\W+)?\b((?:is|are|was|were|be|been) no (\w+)))", std::regex::icase);
    for (std::sregex_iterator found(line.begin(), line.end(), words), end; found != end; ++found) {
        const auto before = (*found)[1].str();
        if (strcasecmp(before.c_str(), "there") == 0 || strcasecmp(before.c_str(), "must") == 0) continue;
        if (!rightful.contains((*found)[3].str())) return (*found)[2].str();
    }
    return "";
}

/// What a line says without its subject or in words that are not used: "nobody" and the like, a sentence of a comment
/// that begins with "Of" ("Of a pass the last line counts"), "is no file" for "is not a file".
std::string riddleIn(const std::string& line) {
    const auto has = [&](const char* part) { return strcasestr(line.c_str(), part) != nullptr; };
    if (has("is no ") || has("are no ") || has("was no ") || has("were no ") || has("be no ") || has("been no ")) {
        if (auto found = misplacedNoIn(line); !found.empty()) return found;
    }
    if (!has("body") && !has("whoever") && !has(" Of ") && !has("broken off")) return "";
    static const std::regex words(R"(\b(nobody|somebody|anybody|whoever|was broken off|is broken off)\b)",
                                  std::regex::icase);
    static const std::regex fragment(R"(//[/!<]*(?:.*[.:;!?)])?\s+Of [a-z])");
    std::smatch found;
    return std::regex_search(line, found, words) || std::regex_search(line, found, fragment) ? found.str() : "";
}

TEST(Language, NamesItsSubjects) {
    std::size_t lines = 0;
    for (const char* top : {"app", "core", "drivers", "tests", "resources/protocols", "resources/help"}) {
        for (const auto& entry : fs::recursive_directory_iterator(test::sourceDir() / top)) {
            const auto kind = entry.path().extension();
            if (kind != ".cpp" && kind != ".h" && kind != ".js" && kind != ".md") continue;
            if (entry.path().filename() == "LanguageTest.cpp") continue;
            std::ifstream in(entry.path(), std::ios::binary);
            std::size_t at = 0;
            for (std::string line; std::getline(in, line);) {
                ++lines;
                ++at;
                EXPECT_EQ(riddleIn(line), "") << fs::relative(entry.path(), test::sourceDir()) << ":" << at;
            }
        }
    }
    EXPECT_GT(lines, 200'000U);
}

TEST(Language, RiddlesAreFound) {
    EXPECT_EQ(riddleIn("x();  // nobody looks"), "nobody");
    EXPECT_EQ(riddleIn("EXPECT_TRUE(x) << \"Whoever asks\";"), "Whoever");
    EXPECT_EQ(riddleIn("    /// Of a pass: what was found"), "/// Of a");
    EXPECT_EQ(riddleIn("x();  // Lines are kept. Of each the last counts"), "// Lines are kept. Of e");
    EXPECT_EQ(riddleIn("x(\"Done. Of two\");  // The Bank Of example"), "");
    EXPECT_EQ(riddleIn("/// The body of a request, of one kind"), "");
    EXPECT_EQ(riddleIn("fail(\"{} is no folder\")"), "is no folder");
    EXPECT_EQ(riddleIn("/// Ten bytes that are no frame."), "are no frame");
    EXPECT_EQ(riddleIn("// Where there is no sensor, R is no longer known, and there\u2019s no file"), "");
    EXPECT_EQ(riddleIn("// There is no sensor. That is no fault."), "is no fault");
    EXPECT_EQ(riddleIn("a session that was broken off"), "was broken off");
}

}  // namespace
}  // namespace tacto
