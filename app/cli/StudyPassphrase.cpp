#include "app/cli/StudyPassphrase.h"

#include <algorithm>
#include <cstdio>
#include <span>
#include <termios.h>
#include <unistd.h>

#include "core/study/StudyFiles.h"

namespace tacto::cli {

namespace {

/// Reads a line from the terminal without showing it.
Result<Secret> typedPassphrase(const char* prompt) {
    ::termios before{};
    if (::isatty(STDIN_FILENO) == 0 || ::tcgetattr(STDIN_FILENO, &before) != 0) {
        return fail(ErrorCode::NotFound,
                    "the study's passphrase is needed: --passphrase-file F with the passphrase in its first line");
    }
    say(stderr, "{}", prompt);
    auto silent = before;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
    Secret line(4096);
    auto* at = reinterpret_cast<char*>(line.bytes().data());
    const auto size = ::read(STDIN_FILENO, at, line.size());  // a terminal delivers one line
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
    say(stderr, "\n");
    auto text = std::string_view(at, size > 0 ? static_cast<std::size_t>(size) : 0);
    if (text.ends_with('\n')) text.remove_suffix(1);
    if (text.empty()) return fail(ErrorCode::NotFound, "no passphrase was given");
    return Secret(std::as_bytes(std::span(text)));
}

/// Reads a passphrase from the file that `option` names.
Result<Passphrase> filed(const QCommandLineParser& parser, const char* option, const std::filesystem::path& study) {
    const auto file = parser.value(option).toStdString();
    if (!liesInside(file, study)) return Passphrase::fromFile(file);
    return fail(ErrorCode::NotFound,
                "the passphrase file {} lies inside the study folder; beside what it opens it protects nothing, so "
                "another place is needed",
                file);
}

}  // namespace

void declarePassphrase(QCommandLineParser& parser) {
    parser.addOption(
        {"passphrase-file", "File whose first line is the study's passphrase; asked for where left out.", "F"});
}

Result<Passphrase> passphraseFor(const QCommandLineParser& parser, const std::filesystem::path& study) {
    if (parser.isSet("passphrase-file")) return filed(parser, "passphrase-file", study);
    const auto typed = typedPassphrase("Passphrase: ");
    return typed ? Passphrase::from(*typed) : failure(typed);
}

Result<Passphrase> newPassphraseFor(const QCommandLineParser& parser, const std::filesystem::path& study) {
    if (parser.isSet("new-passphrase-file")) return filed(parser, "new-passphrase-file", study);
    const auto typed = typedPassphrase("New passphrase: ");
    if (!typed) return failure(typed);
    const auto again = typedPassphrase("Once more: ");
    if (!again) return failure(again);
    if (!std::ranges::equal(typed->bytes(), again->bytes()))
        return fail(ErrorCode::NotFound, "the two are not the same; nothing was changed");
    return Passphrase::from(*typed);
}

Result<Study> openStudy(const QCommandLineParser& parser, const std::filesystem::path& folder, Study::Access access) {
    if (!Study::isThere(folder)) return fail(ErrorCode::NotFound, "there is no study in {}", folder.string());
    const auto without = Study::open(folder, nullptr, Study::Access::Read);
    if (!without) return failure(without);
    const bool needsNone =
        without->isRehearsal() || (access == Study::Access::Read && !parser.isSet("passphrase-file"));
    if (needsNone) return Study::open(folder, nullptr, access);
    const auto passphrase = passphraseFor(parser, folder);
    if (!passphrase) return failure(passphrase);
    return Study::open(folder, &*passphrase, access);
}

}  // namespace tacto::cli
