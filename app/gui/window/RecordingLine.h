// RecordingLine.h - the line at the bottom: what is being recorded, how much, and how safely; and the last message with
// its time. A click shows all messages.
#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QStatusBar>
#include <QStringList>
#include <QToolButton>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class RecordingLine final : public QObject {
    Q_OBJECT
public:
    RecordingLine(BenchController& controller, QStatusBar& bar);
    void refresh();
    /// While the operator is blind, leaves out how much was written and when, as both change with each train, and the
    /// numbers in messages.
    void setBlind(bool blind);
    /// Returns a message in the form that may be shown now.
    [[nodiscard]] QString shown(const QString& text) const;
    /// Shows a message and keeps it in the log.
    void say(const QString& message, bool isError = false);
    /// True if the message on the line says that the output is off.
    [[nodiscard]] bool saysOff() const;
    void showLog();
    /// Gives the message the room it needs; the text about the recording is shortened first.
    bool eventFilter(QObject* watched, QEvent* event) override;
    [[nodiscard]] const QStringList& log() const { return log_; }

private:
    void sayRecording(const QString& text);
    void sayRecorded(const std::filesystem::path& session);
    void fixHeight();
    void fitMessage();

    BenchController& controller_;
    QStatusBar& bar_;
    QLabel* recording_;
    QToolButton* message_;
    QString said_;  // the last message with its time
    QStringList log_;
    QElapsedTimer since_;
    QElapsedTimer looked_;
    std::filesystem::path session_;
    bool blind_ = false;
};

}  // namespace tacto::gui
