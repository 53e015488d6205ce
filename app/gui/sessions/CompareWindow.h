// CompareWindow.h - two sessions over each other: trials in one plane, a stream of both with its difference, and what
// differs in what was used and found, in sentences.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QDialog>
#include <qcustomplot.h>

#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/ReadSession.h"

namespace tacto::gui {

class CompareWindow final : public QDialog {
    Q_OBJECT
public:
    CompareWindow(std::shared_ptr<const ReadSession> first, std::shared_ptr<const ReadSession> second, QWidget* parent);

private:
    void drawTrials();
    void drawStream();
    void overlay(const SampleBlock& a, const SampleBlock& b, std::size_t columns, const QString& label);
    std::shared_ptr<const ReadSession> sessions_[2];
    QCustomPlot* plane_;
    QCustomPlot* streams_;
    QComboBox* stream_;
    Background background_;
};

}  // namespace tacto::gui
