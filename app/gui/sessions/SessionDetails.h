// SessionDetails.h - one session: its overview, trials, streams, captures, and about.
//
// Thread-safety: the GUI thread; the data shown was read on another thread.
#pragma once

#include <QSplitter>
#include <QTabWidget>
#include <QTableWidget>
#include <QTextBrowser>
#include <memory>
#include <qcustomplot.h>

#include "app/gui/sessions/ReadSession.h"
#include "app/run/Shipped.h"

namespace tacto::gui {

class SessionOverview;

class SessionDetails final : public QTabWidget {
    Q_OBJECT
public:
    /// `limits`, which give the titles of limit sets, must outlive this.
    explicit SessionDetails(const ShippedLimits& limits, QWidget* parent = nullptr);
    void show(std::shared_ptr<const ReadSession> session);
    void say(const QString& why);
    /// Returns the capture of the chosen row; nothing if none is chosen.
    [[nodiscard]] std::optional<std::int64_t> chosenCapture() const;
    /// Draws the samples of a stream, which were read on another thread.
    void showStream(const SessionStreamInfo& info, const SampleBlock& samples);
    /// Returns the operator's marks on the stream drawn.
    [[nodiscard]] const MarkLines& marks() const { return *marks_; }

signals:
    void captureActivated(qint64 seq);
    void streamChosen(int stream);
    void labelsSaved(const QString& session);
    void labelsRefused(const QString& why);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] QString aboutHtml() const;
    void chooseStream();
    void clearStream();
    [[nodiscard]] QCPAxis& axisFor(const QString& unit);
    void removeAxes();
    void drawMarks();
    void colour();
    void fitTabs();
    void fitLook();
    void fitStreams();
    std::shared_ptr<const ReadSession> session_;
    const ShippedLimits& limits_;
    SessionOverview* overview_;
    QTextBrowser* about_;
    QTableWidget* trials_;
    QSplitter* split_;          ///< the streams, above the chosen stream's plot
    bool splitByHand_ = false;  ///< true once the user has dragged their heights
    QTableWidget* streams_;
    QCustomPlot* plot_;
    QCPItemText* watermark_ = nullptr;
    std::vector<std::pair<QString, QCPAxis*>> axes_;  // axes of the units drawn; owned by the plot
    std::unique_ptr<MarkLines> marks_;
    QTableWidget* captures_;
};

}  // namespace tacto::gui
