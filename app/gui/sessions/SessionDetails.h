// SessionDetails.h - one session: about, verdict, trials, events, streams, captures.
//
// Thread-safety: the GUI thread; what is shown was read beside it.
#pragma once

#include <QTabWidget>
#include <QTableWidget>
#include <QTextBrowser>
#include <memory>
#include <qcustomplot.h>

#include "core/base/Stream.h"
#include "core/measure/Capture.h"
#include "core/session/SessionTypes.h"

namespace tacto::gui {

/// A session read for looking at: everything but the samples.
struct ReadSession {
    std::filesystem::path path;
    SessionAbout about;
    bool closed = false;
    std::string head;
    std::vector<std::string> marks;  ///< of sessionMarks()
    std::vector<SessionVerdict> verdicts;
    std::vector<SessionTrial> trials;
    std::vector<SessionRow> events;
    std::vector<SessionRow> log;
    std::vector<SessionStreamInfo> streams;
    std::vector<SessionCaptureInfo> captures;
};
/// Errors: as SessionReader.
[[nodiscard]] Result<ReadSession> readSession(const std::filesystem::path& path);

class SessionDetails final : public QTabWidget {
    Q_OBJECT
public:
    explicit SessionDetails(QWidget* parent = nullptr);
    void show(std::shared_ptr<const ReadSession> session);
    void say(const QString& why);
    /// Of the chosen row; nothing when there is none.
    [[nodiscard]] std::optional<std::int64_t> chosenCapture() const;
    /// 0 when there is none.
    [[nodiscard]] int chosenStream() const;
    /// Draws the samples of a stream, read beside the window.
    void showStream(const SessionStreamInfo& info, const SampleBlock& samples);

signals:
    void captureActivated(qint64 seq);
    void streamChosen(int stream);

protected:
    void changeEvent(QEvent* event) override;

private:
    [[nodiscard]] QString aboutHtml() const;
    void fill(QTableWidget& table, const QStringList& header, const QList<QStringList>& rows);
    std::shared_ptr<const ReadSession> session_;
    QTextBrowser* about_;
    QTableWidget* trials_;
    QTableWidget* events_;
    QTableWidget* streams_;
    QCustomPlot* plot_;
    QTableWidget* captures_;
};

}  // namespace tacto::gui
