// ProgressBar.h - a progress bar whose words are read over what is filled and over what is not.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QProgressBar>

namespace tacto::gui {

class ProgressBar final : public QProgressBar {
public:
    using QProgressBar::QProgressBar;

protected:
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace tacto::gui
