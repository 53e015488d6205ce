// Rules for sources: a file is named after what it holds; lines fit in 120 columns; limits are called kMin or kMax;
// only one place asks the environment for the user's data folders.
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <regex>
#include <set>

#include "tests/support/Support.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxColumns = 120;

/// Calls `see` with the path in the tree and the text of each source, header and source list below `folders`.
void forSources(std::initializer_list<const char*> folders,
                const std::function<void(const fs::path&, const std::string&)>& see) {
    for (const char* folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(test::sourceDir() / folder)) {
            const auto ending = entry.path().extension();
            const bool list = entry.path().filename() == "CMakeLists.txt";
            if (ending != ".cpp" && ending != ".h" && ending != ".c" && ending != ".js" && !list) continue;
            std::ifstream in(entry.path(), std::ios::binary);
            see(fs::relative(entry.path(), test::sourceDir()), {std::istreambuf_iterator<char>(in), {}});
        }
    }
}

/// Counts the code points of UTF-8 text.
std::size_t columnsOf(std::string_view line) {
    return static_cast<std::size_t>(
        std::ranges::count_if(line, [](char each) { return (static_cast<unsigned char>(each) & 0xC0) != 0x80; }));
}

TEST(Sources, ALineFitsIn120Columns) {
    std::size_t lines = 0;
    forSources({"app", "core", "drivers", "tests", "resources"}, [&](const fs::path& file, const std::string& text) {
        std::size_t number = 0;
        for (std::size_t from = 0; from < text.size(); ++lines) {
            const auto end = std::min(text.find('\n', from), text.size());
            ++number;
            EXPECT_LE(columnsOf(std::string_view(text).substr(from, end - from)), kMaxColumns) << file << ":" << number;
            from = end + 1;
        }
    });
    EXPECT_GT(lines, 100'000U);
}

TEST(Sources, AFileIsAThingAndNoRestOfOne) {
    static const std::regex rest(R"(.*(Parts|Draw|Memory|Helpers?|Utils?|Manager|Misc|Common)$)");
    forSources({"app", "core", "drivers", "tests"}, [](const fs::path& file, const std::string&) {
        EXPECT_FALSE(std::regex_match(file.stem().string(), rest)) << file;
    });
}

TEST(Sources, ALimitIsNamedByMinOrMax) {
    static const std::regex other(R"(\bk(Most|Fewest|Least)([A-Z_]\w*)?\b)");
    forSources({"app", "core", "drivers", "tests"}, [](const fs::path& file, const std::string& text) {
        if (file.filename() == "SourcesTest.cpp") return;
        for (const char* begin : {"kMost", "kFewest", "kLeast"}) {
            if (text.find(begin) == std::string::npos) continue;
            std::smatch found;
            EXPECT_FALSE(std::regex_search(text, found, other)) << file << ": " << found.str();
        }
    });
}

// The linker merges two types of the same name in one program and keeps only one's functions: memory is overrun.
TEST(Sources, TwoTypesOfANamespaceHaveTwoNames) {
    static const std::regex within("(?:^|\n)namespace ([\\w:]+) \\{");
    static const std::regex type("\n(?:struct|class) (\\w+)(?: final)?(?: :[^{;]*)? \\{");
    std::map<std::string, fs::path> known;
    forSources({"app", "core", "drivers"}, [&](const fs::path& file, const std::string& text) {
        std::smatch space;
        if (file.extension() != ".h" || !std::regex_search(text, space, within)) return;
        for (std::sregex_iterator each(text.begin(), text.end(), type), end; each != end; ++each) {
            const auto [other, isNew] = known.try_emplace(space.str(1) + "::" + each->str(1), file);
            EXPECT_TRUE(isNew) << other->first << " in " << other->second << " and " << file;
        }
    });
    EXPECT_GT(known.size(), 500U);
}

TEST(Sources, TheUsersDataLieWhereOneFunctionSays) {
    std::vector<std::string> asking;
    forSources({"app", "core", "drivers"}, [&](const fs::path& file, const std::string& text) {
        if (text.find("getenv(\"XDG_DATA_HOME\")") != std::string::npos) asking.push_back(file.string());
    });
    EXPECT_THAT(asking, testing::ElementsAre("core/base/ProgramStart.cpp"));
}

// Qt sets the locale of the C library, and std::locale("") uses it too: under a Turkish locale letters change case
// differently, and under a German one numbers have a decimal comma. core/base/LocaleFreeText.h and fmt ignore locales.
const std::set<std::string_view> kFollowsTheLocale{
    "tolower",  "toupper",  "towlower",  "towupper", "isalnum",    "isalpha",  "isblank",  "iscntrl",    "isdigit",
    "isgraph",  "islower",  "isprint",   "ispunct",  "isspace",    "isupper",  "isxdigit", "iswalpha",   "iswspace",
    "strtod",   "strtof",   "strtold",   "strtol",   "strtoll",    "strtoul",  "strtoull", "atof",       "atoi",
    "atol",     "atoll",    "stod",      "stof",     "stold",      "stoi",     "stol",     "stoll",      "stoul",
    "stoull",   "printf",   "fprintf",   "sprintf",  "snprintf",   "vprintf",  "vfprintf", "vsnprintf",  "scanf",
    "fscanf",   "sscanf",   "strcoll",   "strxfrm",  "strcasecmp", "strftime", "strptime", "put_time",   "get_time",
    "mbstowcs", "wcstombs", "put_money", "imbue",    "localeconv", "iequals",  "to_lower", "strncasecmp"};

/// Returns the first name in `line` that depends on the locale; a function is a name before a bracket.
std::string followingTheLocale(std::string_view line) {
    line = line.substr(0, line.find("//"));
    for (const std::string_view text : {"std::locale", "std::regex", "std::wregex", "QLocale::system", "QLocale()"})
        if (line.find(text) != std::string_view::npos) return std::string(text);
    for (auto at = line.find('('); at != std::string_view::npos; at = line.find('(', at + 1)) {
        auto begin = at;
        const auto isOfName = [](char c) {
            return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        };
        while (begin > 0 && isOfName(line[begin - 1])) --begin;
        if (const auto name = line.substr(begin, at - begin); kFollowsTheLocale.contains(name))
            return std::string(name);
    }
    for (const std::string_view name : {"std::tolower", "std::toupper", "std::isspace", "std::isdigit", "std::isalpha"})
        if (line.find(name) != std::string_view::npos) return std::string(name);
    return {};
}

TEST(Sources, NothingFollowsTheLocale) {
    std::size_t lines = 0;
    forSources({"app", "core", "drivers"}, [&](const fs::path& file, const std::string& text) {
        if (file.extension() != ".cpp" && file.extension() != ".h") return;
        std::size_t number = 0;
        for (std::size_t from = 0; from < text.size(); ++lines) {
            const auto end = std::min(text.find('\n', from), text.size());
            ++number;
            EXPECT_EQ(followingTheLocale(std::string_view(text).substr(from, end - from)), "") << file << ":" << number;
            from = end + 1;
        }
    });
    EXPECT_GT(lines, 100'000U);
    EXPECT_EQ(followingTheLocale("x = std::tolower(c);"), "tolower");
    EXPECT_EQ(followingTheLocale("transform(a, b, std::toupper);  // by its name"), "std::toupper");
    EXPECT_EQ(followingTheLocale("y = letters.isDigit() && tolowered(z);  // not tolower(z)"), "");
}

}  // namespace
}  // namespace tacto
