// CompareWindow.h - compares two sessions, A and B: a table of what differs, and one figure of a trace of both: their
// trials, a stream, or what the oscilloscope captured in the same condition.
#pragma once

#include <QComboBox>
#include <QDialog>
#include <QSplitter>
#include <array>
#include <memory>
#include <qcustomplot.h>

#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/ReadSession.h"
#include "app/gui/theme/MarkLines.h"

namespace tacto::gui {

class ResultTables;

class CompareWindow final : public QDialog {
    Q_OBJECT
public:
    CompareWindow(std::shared_ptr<const ReadSession> a, std::shared_ptr<const ReadSession> b, QWidget* parent);
    /// Returns the operator's marks of both sessions on the stream drawn.
    [[nodiscard]] const MarkLines& marks() const { return *marks_; }

private:
    enum class Source { Trials, Stream, Capture };
    /// What both sessions hold and the figure can show; `at` is a stream's id or a capture's row in each session.
    struct Drawn {
        Source source = Source::Trials;
        QString title{};
        QString unit{};
        std::array<std::int64_t, 2> at{};
        std::size_t column = 0;
    };
    /// The curve of one session: seconds from its beginning (of a capture: from its trigger), and values.
    struct Trace {
        std::vector<double> t, y;
        double begins_s = 0;
    };
    using Both = std::array<Trace, 2>;
    [[nodiscard]] QWidget* buildFigure(QWidget* parent);
    void offerTrials();
    void offerStreams();
    void offerCaptures();
    void offer(Drawn drawn);
    [[nodiscard]] static Result<Both> read(const std::array<std::filesystem::path, 2>& paths, const Drawn& drawn);
    void draw();
    void drawTrials();
    void overlay(Both both, const Drawn& drawn);
    void drawMarks();
    void colour();
    void fit();
    std::array<std::shared_ptr<const ReadSession>, 2> sessions_;
    QSplitter* split_ = nullptr;
    bool fitted_ = false;
    ResultTables* tables_ = nullptr;
    QComboBox* which_ = nullptr;
    QCustomPlot* plot_ = nullptr;
    std::vector<Drawn> drawn_;          ///< in the order of which_
    std::array<double, 2> begins_s_{};  ///< when the streams drawn begin, each on its own time base
    std::unique_ptr<MarkLines> marks_;
    Background background_;
};

}  // namespace tacto::gui
