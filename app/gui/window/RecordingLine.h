// RecordingLine.h - the bottom line: what is being recorded, how much, how safe it is; the last message with its time,
// click for all.
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
    /// While blind it says neither how much is written nor when, as both come with each train, and leaves numbers out
    /// of messages.
    void setBlind(bool blind);
    /// A message as it may be shown now.
    [[nodiscard]] QString shown(const QString& text) const;
    /// Shows a message and keeps it in the log.
    void say(const QString& message, bool isError = false);
    /// Whether the message on the line says that the output is off.
    [[nodiscard]] bool saysOff() const;
    void showLog();
    /// The message has the room that it needs; what is being recorded is elided before it.
    bool eventFilter(QObject* watched, QEvent* event) override;
    [[nodiscard]] const QStringList& log() const { return log_; }

private:
    void sayRecording(const QString& text);
    void sayRecorded(const std::filesystem::path& session);
    void fitMessage();

    BenchController& controller_;
    QStatusBar& bar_;
    QLabel* recording_;
    QToolButton* message_;
    QString said_;  // what was said, with its time
    QStringList log_;
    QElapsedTimer since_;
    QElapsedTimer looked_;
    std::filesystem::path session_;
    bool blind_ = false;
};

}  // namespace tacto::gui
