// ScopeEmpty.h - the oscilloscope before there is a bench or a capture: what it is for, and the two ways to begin.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

class ScopeEmpty final : public EmptyState {
    Q_OBJECT
public:
    explicit ScopeEmpty(QWidget* parent = nullptr);
    /// Why the last file was not opened; empty: nothing went wrong.
    void setProblem(const QString& problem);

signals:
    void openClicked();

private:
    TroubleLine* problem_;
};

}  // namespace tacto::gui
