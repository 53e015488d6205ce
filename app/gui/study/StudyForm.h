// StudyForm.h - form for the settings of a new study or of an amendment: the place, label and explanation of each
// field.
//
// Units, ranges, words and defaults come from the core's table (studyFields() of core/study/StudySettings.h), which
// alone decides what is valid.
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
    const char* needed = nullptr;      ///< what is unknown without a value; null: the default is used
    std::vector<const char*> words{};  ///< the file's words, in order, phrased for people; empty: as they are
};
[[nodiscard]] const std::vector<StudyFormField>& studyForm();

class StudyForm final : public QWidget {
    Q_OBJECT
public:
    explicit StudyForm(QWidget* parent = nullptr);
    /// Returns the form's settings, with the approval's facts about this program and about `profile`, with which the
    /// sessions are run. Errors: of the first refused or missing field.
    [[nodiscard]] Result<StudySettings> read(const Profile& profile, const QString& folder = {});
    /// Sets a field as if typed.
    void set(const std::string& key, const QString& text);
    void clear();
    /// Begins an amendment: shows `settings`; the amendment's own reference is still to be entered.
    void amend(const StudySettings& settings);

signals:
    void edited();

private:
    void fill();
    std::optional<StudySettings> amended_;  ///< nothing for a new study
    std::vector<FieldForm*> groups_;
};

}  // namespace tacto::gui
