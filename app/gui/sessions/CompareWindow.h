// CompareWindow.h - compares two sessions: their trials in one plane, a stream of both with its difference, and
// sentences that say how settings and results differ.
#pragma once

#include <QComboBox>
#include <QDialog>
#include <array>
#include <memory>
#include <qcustomplot.h>

#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/ReadSession.h"
#include "app/gui/theme/MarkLines.h"

namespace tacto::gui {

class CompareWindow final : public QDialog {
    Q_OBJECT
public:
    CompareWindow(std::shared_ptr<const ReadSession> first, std::shared_ptr<const ReadSession> second, QWidget* parent);
    /// Returns the operator's marks of both sessions on the stream drawn.
    [[nodiscard]] const MarkLines& marks() const { return *marks_; }

private:
    /// The trials of one condition in one of the two sessions.
    struct Trials {
        QCPGraph* graph = nullptr;
        QString condition;
        int number = 0;  ///< the condition's number
        bool first = true;
    };
    void drawTrials();
    void drawStream();
    void drawMarks();
    void colour();
    void colourTrials();
    void colourStreams();
    /// A column of a stream that both sessions have, and its axis title without the unit prefix.
    struct Drawn {
        SessionStream stream;
        std::size_t column = 0;
        QString title;
        QString unit;
    };
    void overlay(const SampleBlock& a, const SampleBlock& b, const Drawn& drawn);
    std::shared_ptr<const ReadSession> sessions_[2];
    QCustomPlot* plane_;
    std::vector<Trials> trials_;
    QCPItemText* noTrials_ = nullptr;  ///< says that there are no trials; null if there are some
    QCustomPlot* streams_;
    QComboBox* stream_;
    std::vector<Drawn> drawn_;          // in the order of stream_
    std::array<double, 2> begins_s_{};  // start times of the streams drawn, each on its own time base
    std::unique_ptr<MarkLines> marks_;
    Background background_;
};

}  // namespace tacto::gui
