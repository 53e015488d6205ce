// StudyForm.h - the settings of a study, new or to be amended, as people read them: where each stands in the form, its
// label, what it does.
//
// Units, ranges, words and defaults come from the core's table (studyFields() of core/study/StudySettings.h), which
// alone judges.
#pragma once

#include <QBoxLayout>
#include <QWidget>
#include <vector>

#include "app/gui/theme/FieldForm.h"
#include "core/bench/Profile.h"
#include "core/study/StudySettings.h"

namespace tacto::gui {

enum class StudyGroup { Approval, Participants, Site, Train, Test };
inline constexpr int kStudyGroups = 5;

struct StudyFormField {
    StudyGroup group;
    std::string_view key;  ///< "electrode.area_cm2" for a member of a record
    const char* label;
    const char* tip;
    const char* needed = nullptr;      ///< what stays unknown without it; null: its default will do
    std::vector<const char*> words{};  ///< the file's words in their order, put for people; empty: as they are
};
[[nodiscard]] const std::vector<StudyFormField>& studyForm();

class StudyForm final : public QWidget {
    Q_OBJECT
public:
    explicit StudyForm(QWidget* parent = nullptr);
    /// The form's settings, with what the approval says of this program and of `profile`, which its sessions are run
    /// with. Errors: of the first field that is refused or missing; the form goes there.
    [[nodiscard]] Result<StudySettings> read(const Profile& profile);
    /// Writes into a field, as if it were typed.
    void set(const std::string& key, const QString& text);
    void clear();
    /// Begins an amendment: fields hold `settings`, and the reference is the amendment's, which is still to be entered.
    void amend(const StudySettings& settings);

signals:
    void edited();

private:
    void fill();
    std::optional<StudySettings> amended_;  ///< nothing for a new study
    std::vector<FieldForm*> groups_;
};

}  // namespace tacto::gui
