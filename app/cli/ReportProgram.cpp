#include "app/cli/ReportProgram.h"

#include <QProcess>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sys/prctl.h>
#include <unistd.h>

#include "app/cli/Command.h"
#include "core/base/ProgramStart.h"

namespace tacto::cli {

namespace {

std::string programPath() { return programBeside("tactoscope-report").string(); }

Error missing(const std::string& why) {
    return {ErrorCode::NotFound, fmt::format("{} does not start ({}); install Tactoscope again", programPath(), why)};
}

/// Returns the program's message without its name at the beginning of a line.
std::string sentenceIn(const QByteArray& said) {
    constexpr std::string_view kName = "tactoscope-cli: ";
    auto text = said.trimmed().toStdString();
    return text.starts_with(kName) ? text.substr(kName.size()) : text;
}

}  // namespace

int becomeReportProgram(char** argv) {
    auto path = programPath();
    char** words = argv + 1;  // the words after "report" follow the program's name
    words[0] = path.data();
    ::execv(path.c_str(), words);
    return couldNotRun(missing(std::strerror(errno)));
}

Result<void> makeReports(const std::filesystem::path& session, const std::vector<std::filesystem::path>& outs) {
    QStringList words{QString::fromStdString(session.string())};
    for (const auto& out : outs) words << "--out" << QString::fromStdString(out.string());
    QProcess program;
    program.setProgram(QString::fromStdString(programPath()));
    program.setArguments(words);
    program.setStandardInputFile(QProcess::nullDevice());
    program.setStandardOutputFile(QProcess::nullDevice());
    program.setChildProcessModifier([] {
        ::setpgid(0, 0);  // Ctrl+C goes only to the calling program, which then says what was not done
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    });
    program.start();
    if (!program.waitForStarted()) return tl::unexpected(missing(program.errorString().toStdString()));
    program.waitForFinished(-1);
    const auto sentence = sentenceIn(program.readAllStandardError());
    if (program.exitStatus() != QProcess::NormalExit)
        return fail(ErrorCode::Io, "{} ended unexpectedly while it wrote {}", programPath(),
                    words.sliced(1).join(" ").toStdString());
    if (program.exitCode() == kDone) return {};
    if (program.exitCode() != kVerdictFailed) return fail(ErrorCode::Io, "{}", sentence);
    say(stderr, "tactoscope-cli: {}\n", lines(sentence));
    return {};
}

}  // namespace tacto::cli
