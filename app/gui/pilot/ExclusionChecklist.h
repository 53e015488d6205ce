// ExclusionChecklist.h - the questions of the exclusion checklist, each answered by yes or no. No answer is
// preselected.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QButtonGroup>
#include <QWidget>
#include <vector>

#include "core/study/Gates.h"

namespace tacto::gui {

class ExclusionChecklist final : public QWidget {
    Q_OBJECT
public:
    explicit ExclusionChecklist(QWidget* parent = nullptr);
    void clear();
    /// Those that are answered, in order.
    [[nodiscard]] std::vector<ExclusionAnswer> answers() const;
    [[nodiscard]] bool whole() const { return answers().size() == groups_.size(); }

signals:
    void changed();

private:
    enum Answer { kNo, kYes };
    std::vector<QButtonGroup*> groups_;  ///< as exclusionItems()
};

}  // namespace tacto::gui
