#include "app/gui/window/DisplayWatch.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace tacto::gui {

namespace {

constexpr std::array<const char*, 3> kDisplayVariables{"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"};

/// Returns the environment variables that name a display, such as 'DISPLAY is ":77"'.
QString namedDisplays() {
    QStringList all;
    for (const char* name : kDisplayVariables) {
        if (!qEnvironmentVariableIsEmpty(name)) all << QString("%1 is \"%2\"").arg(name, qEnvironmentVariable(name));
    }
    return all.isEmpty() ? QString("DISPLAY and WAYLAND_DISPLAY are empty") : all.join(", ");
}

QString noDisplay(const QString& why) {
    return QString("tactoscope: no display: %1%2; tactoscope-cli needs none").arg(namedDisplays(), why);
}

struct Heard {
    QStringList all;
    QStringList reasons;  // why each display that was tried cannot be used
    std::string timeout;  // prepared text, because the signal handler must not build one
};
Heard& heard() {
    static Heard heard;
    return heard;
}

[[noreturn]] void endProgram(std::string_view text) noexcept {
    while (!text.empty()) {
        const auto written = ::write(STDERR_FILENO, text.data(), text.size());
        if (written <= 0) break;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    std::_Exit(3);
}

void hear(QtMsgType type, const QMessageLogContext& context, const QString& text) {
    auto& to = heard();
    if (type == QtFatalMsg) {
        const auto why = to.reasons.isEmpty() ? text.section('\n', 0, 0) : to.reasons.join(", ");
        endProgram(noDisplay(QString(" (%1)").arg(why)).toStdString() + '\n');
    }
    to.all << text;
    // Qt repeats in another message that the plugin did not start.
    const bool isOfDisplay = QString(context.category).startsWith("qt.qpa") || text.contains("display");
    const bool isReason = isOfDisplay && !text.contains("even though it was found");
    if (isReason && !to.reasons.contains(text)) to.reasons << text.simplified();
}

void timeIsUp(int) { endProgram(heard().timeout); }

}  // namespace

std::optional<QString> DisplayWatch::noneIsNamed(const QStringList& arguments) {
    if (arguments.contains("-platform") || arguments.contains("--platform")) return std::nullopt;
    if (std::ranges::all_of(kDisplayVariables, qEnvironmentVariableIsEmpty)) return noDisplay({});
    return std::nullopt;
}

DisplayWatch::DisplayWatch() {
    heard().timeout = noDisplay(QString(", which has not answered for %1 s").arg(kWait_s)).toStdString() + '\n';
    qInstallMessageHandler(hear);
    std::signal(SIGALRM, timeIsUp);
    ::alarm(kWait_s);
}

DisplayWatch::~DisplayWatch() {
    ::alarm(0);
    std::signal(SIGALRM, SIG_DFL);
    qInstallMessageHandler(nullptr);
    for (const auto& text : heard().all) qWarning("%s", qUtf8Printable(text));
    heard() = {};
}

}  // namespace tacto::gui
