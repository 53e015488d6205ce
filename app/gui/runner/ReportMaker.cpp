#include "app/gui/runner/ReportMaker.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <array>
#include <fcntl.h>
#include <unistd.h>

#include "core/base/WholeFile.h"

namespace tacto::gui {

namespace {

constexpr int kDamaged = 1;  // tactoscope-report's exit code for: written, but the session was altered

}  // namespace

ReportMaker::ReportMaker(QObject* parent) : QObject(parent) {
    connect(&process_, &QProcess::finished, this, &ReportMaker::ended);
    connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error != QProcess::FailedToStart) return;
        emit failed(tr("No report: %1 cannot be started (%2).").arg(process_.program(), process_.errorString()));
        next();
    });
}

ReportMaker::~ReportMaker() {
    process_.disconnect(this);
    process_.kill();
    process_.waitForFinished(1000);  // a killed process ends at once
    if (!out_.isEmpty()) removeDraftsOf(writer_, out_.toStdString());
}

void ReportMaker::make(const QString& session, const QString& out) {
    make(Order{.record = session, .out = out, .assurance = tr("The session is complete.")});
}

void ReportMaker::make(const Order& order) {
    queue_.append(order);
    if (process_.state() == QProcess::NotRunning) next();
}

void ReportMaker::cancel() {
    queue_.clear();
    if (process_.state() == QProcess::NotRunning) return;
    cancelled_ = true;
    process_.kill();
    process_.waitForFinished(1000);  // waits briefly; ended() emits failed() during this call
}

void ReportMaker::next() {
    if (queue_.isEmpty()) return;
    const auto order = queue_.takeFirst();
    out_ = order.out;
    assurance_ = order.assurance;
    signs_ = order.signs;
    cancelled_ = false;
    start(QStringList{order.record, "--out", order.out} + order.more, order.passphrase.get());
}

void ReportMaker::start(const QStringList& words, const Secret* passphrase) {
    const auto program = QCoreApplication::applicationDirPath() + "/tactoscope-report";
    process_.setStandardInputFile(QProcess::nullDevice());
    std::array<int, 2> ends{-1, -1};
    const bool piped = passphrase != nullptr && ::pipe2(ends.data(), O_CLOEXEC) == 0;
    if (piped) {
        // The pipe is larger than any passphrase, so nothing blocks. QProcess::write() would keep a copy.
        const auto bytes = passphrase->bytes();
        const bool whole = ::write(ends[1], bytes.data(), bytes.size()) == ssize_t(bytes.size());
        ::close(ends[1]);
        if (whole) process_.setStandardInputFile(QString("/proc/self/fd/%1").arg(ends[0]));
    }
    process_.start(program, passphrase == nullptr ? words : words + QStringList{"--passphrase-file", "/dev/stdin"});
    writer_ = int(process_.processId());
    if (piped) ::close(ends[0]);
}

void ReportMaker::ended(int code, QProcess::ExitStatus status) {
    const auto said = QString::fromUtf8(process_.readAllStandardError()).trimmed().remove("tactoscope-cli: ");
    const auto out = std::exchange(out_, QString());
    if (status == QProcess::CrashExit) removeDraftsOf(writer_, out.toStdString());
    if (cancelled_)
        emit failed(tr("The report was cancelled. %1").arg(assurance_));
    else if (status == QProcess::CrashExit)
        emit failed(tr("No report: the program that draws it ended unexpectedly. %1").arg(assurance_));
    else if (code == kDamaged && QFileInfo::exists(out)) {
        emit done(out, signs_);
        emit failed(said);
    } else if (code != 0)
        emit failed(tr("No report: %1. %2").arg(said, assurance_));
    else
        emit done(out, signs_);
    next();
}

}  // namespace tacto::gui

#include "moc_ReportMaker.cpp"
