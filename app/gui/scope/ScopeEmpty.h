// ScopeEmpty.h - the oscilloscope before there is a bench or a capture: what it is for, and the two ways to begin.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

class ScopeEmpty final : public EmptyState {
    Q_OBJECT
public:
    explicit ScopeEmpty(QWidget* parent = nullptr);

signals:
    void openClicked();
};

}  // namespace tacto::gui
