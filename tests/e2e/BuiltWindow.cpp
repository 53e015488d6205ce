#include "tests/e2e/BuiltWindow.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTest>

#include "tests/gui/Person.h"

namespace tacto::test {

namespace {

bool xdotool(const QStringList& arguments, QString* says = nullptr) {
    QProcess hand;
    hand.start("xdotool", arguments);
    if (!hand.waitForFinished(10'000)) return false;
    if (says != nullptr) *says = QString::fromUtf8(hand.readAllStandardOutput()).trimmed();
    return hand.exitStatus() == QProcess::NormalExit && hand.exitCode() == 0;
}

}  // namespace

void PersonsTime::reads(const QString& text) {
    static const QRegularExpression word("[\\p{L}\\p{N}]+");
    auto words = word.globalMatch(text);
    for (; words.hasNext(); words.next()) spent_s_ += 1 / kWordsPerSecond;
}

BuiltWindow::BuiltWindow() {
    auto environment = QProcessEnvironment::systemEnvironment();
    const auto folder = [&](const char* variable, const QString& name) {
        QDir(home_.path()).mkpath(name);
        environment.insert(variable, home_.filePath(name));
    };
    environment.insert("HOME", home_.path());
    folder("XDG_CONFIG_HOME", "config");
    folder("XDG_DATA_HOME", "data");
    folder("XDG_CACHE_HOME", "cache");
    folder("XDG_RUNTIME_DIR", "run");
    QFile(home_.filePath("run")).setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    QDir(home_.path()).mkpath("asked");
    const QDir bin(QCoreApplication::applicationDirPath());
    environment.insert("QT_PLUGIN_PATH", bin.filePath("../test-plugins"));
    environment.insert("QT_QPA_GENERIC_PLUGINS", "whereabouts:" + home_.filePath("asked"));
    program_.setProcessEnvironment(environment);
    program_.setProcessChannelMode(QProcess::ForwardedChannels);
    program_.setProgram(bin.filePath("tactoscope"));
}

BuiltWindow::~BuiltWindow() {
    program_.terminate();
    if (!program_.waitForFinished(5000)) program_.kill();
    program_.waitForFinished(5000);
}

bool BuiltWindow::start() {
    program_.start();
    const bool there = comesTrue(
        [this] {
            return xdotool({"search", "--onlyvisible", "--name", "^Tactoscope$"}, &window_) && !window_.isEmpty();
        },
        30'000);
    if (!there) return false;
    window_ = window_.section('\n', 0, 0);
    return xdotool({"windowsize", "--sync", window_, "1440", "900"}) && focus() &&
           comesTrue([this] { return stands("stopButton"); }, 20'000);
}

QString BuiltWindow::ask(const QString& question) {
    const auto path = [this](const char* name) { return home_.filePath(QString("asked/") + name); };
    QFile::remove(path("answer"));
    QFile asked(path("ask.new"));
    if (!asked.open(QIODevice::WriteOnly)) return {};
    asked.write(question.toUtf8());
    asked.close();
    if (!asked.rename(path("ask"))) return {};
    QFile answer(path("answer"));
    if (!comesTrue([&] { return answer.exists(); }, 5000) || !answer.open(QIODevice::ReadOnly)) return {};
    return QString::fromUtf8(answer.readAll()).trimmed();
}

bool BuiltWindow::clickOn(const QString& name) {
    const auto at = ask("where " + name).split(' ');
    if (at.size() != 2) return false;
    person.points();
    return xdotool({"mousemove", at[0], at[1], "click", "1"});
}

bool BuiltWindow::press(const QStringList& keys) {
    person.types(keys.size());
    return xdotool(QStringList{"key", "--clearmodifiers"} + keys);
}

bool BuiltWindow::enter(const QString& text) {
    person.types(text.size());
    return xdotool({"type", "--", text});
}

bool BuiltWindow::focus() { return xdotool({"windowfocus", "--sync", window_}); }

bool BuiltWindow::leaves() {
    if (!focus() || !xdotool({"key", "--clearmodifiers", "ctrl+q"})) return false;
    return program_.waitForFinished(10'000) && program_.exitStatus() == QProcess::NormalExit &&
           program_.exitCode() == 0;
}

}  // namespace tacto::test
