#include "app/gui/runner/ReportMaker.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>

namespace tacto::gui {

namespace {

constexpr int kDamaged = 1;  // of tactoscope-cli report: written, of a session that was altered

/// What a killed program leaves beside `out` while it writes: QSaveFile's "report.pdf.AbCdEf".
void removeHalfWritten(const QString& out) {
    const QFileInfo file(out);
    auto folder = file.dir();
    for (const auto& left : folder.entryList({file.fileName() + ".??????"}, QDir::Files)) folder.remove(left);
}

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
    if (!out_.isEmpty()) removeHalfWritten(out_);
}

void ReportMaker::make(const QString& session, const QString& out) {
    queue_.append({session, out});
    if (process_.state() == QProcess::NotRunning) next();
}

void ReportMaker::cancel() {
    queue_.clear();
    if (process_.state() == QProcess::NotRunning) return;
    cancelled_ = true;
    process_.kill();
    process_.waitForFinished(1000);  // at once; failed() comes from here
}

void ReportMaker::next() {
    if (queue_.isEmpty()) return;
    const auto [session, out] = queue_.takeFirst();
    out_ = out;
    cancelled_ = false;
    process_.start(QCoreApplication::applicationDirPath() + "/tactoscope-cli", {"report", session, "--out", out});
}

void ReportMaker::ended(int code, QProcess::ExitStatus status) {
    const auto said = QString::fromUtf8(process_.readAllStandardError()).trimmed().remove("tactoscope-cli: ");
    const auto out = std::exchange(out_, QString());
    if (status == QProcess::CrashExit) removeHalfWritten(out);
    if (cancelled_)
        emit failed(tr("The report was cancelled; the session is complete."));
    else if (status == QProcess::CrashExit)
        emit failed(tr("No report: the program that draws it ended unexpectedly. The session is complete."));
    else if (code == kDamaged && QFileInfo::exists(out)) {
        emit done(out);
        emit failed(said);
    } else if (code != 0)
        emit failed(tr("No report: %1. The session is complete.").arg(said));
    else
        emit done(out);
    next();
}

}  // namespace tacto::gui
