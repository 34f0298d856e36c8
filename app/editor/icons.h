#pragma once
// Font Awesome 4.7 icons that the editor uses, as UTF-8 (Debian's fonts-font-awesome).

namespace voledit::icons {

inline constexpr const char* kVolume = "\xef\x86\xb2";         // cube
inline constexpr const char* kLattice = "\xef\x80\x8a";        // th
inline constexpr const char* kAppearance = "\xef\x82\x80";     // bar-chart
inline constexpr const char* kRender = "\xef\x83\xab";         // lightbulb-o
inline constexpr const char* kHistory = "\xef\x87\x9a";        // history
inline constexpr const char* kScene = "\xef\x86\xb3";          // cubes
inline constexpr const char* kEye = "\xef\x81\xae";            // eye
inline constexpr const char* kEyeOff = "\xef\x81\xb0";         // eye-slash
inline constexpr const char* kAdd = "\xef\x81\xa7";            // plus
inline constexpr const char* kRemove = "\xef\x87\xb8";         // trash
inline constexpr const char* kReset = "\xef\x83\xa2";          // undo
inline constexpr const char* kUndo = "\xef\x83\xa2";           // undo
inline constexpr const char* kRedo = "\xef\x80\x9e";           // repeat
inline constexpr const char* kOpen = "\xef\x81\xbc";           // folder-open
inline constexpr const char* kSave = "\xef\x83\x87";           // floppy-o
inline constexpr const char* kCamera = "\xef\x80\xb0";         // camera
inline constexpr const char* kFrame = "\xef\x82\xb2";          // arrows-alt
inline constexpr const char* kMove = "\xef\x81\x87";           // arrows
inline constexpr const char* kWarning = "\xef\x81\xb1";        // exclamation-triangle
inline constexpr const char* kInfo = "\xef\x81\x9a";           // info-circle
inline constexpr const char* kClose = "\xef\x80\x8d";          // times
inline constexpr const char* kCheck = "\xef\x80\x8c";          // check
inline constexpr const char* kFolder = "\xef\x81\xbb";         // folder
inline constexpr const char* kFile = "\xef\x80\x96";           // file-o
inline constexpr const char* kSearch = "\xef\x80\x82";         // search
inline constexpr const char* kUp = "\xef\x81\xa2";             // arrow-up
inline constexpr const char* kHome = "\xef\x80\x95";           // home
inline constexpr const char* kSun = "\xef\x86\x85";            // sun-o
inline constexpr const char* kOpenSection = "\xef\x84\x87";    // angle-down
inline constexpr const char* kClosedSection = "\xef\x84\x85";  // angle-right
inline constexpr const char* kFit = "\xef\x81\xa5";            // expand
inline constexpr const char* kLink = "\xef\x83\x81";           // link
inline constexpr const char* kSolid = "\xef\x84\x91";          // circle
inline constexpr const char* kCombine = "\xef\x89\x87";        // object-group
inline constexpr const char* kFormula = "\xef\x84\xab";        // superscript
inline constexpr const char* kTransfer = "\xef\x81\xb4";       // random
inline constexpr const char* kMagic = "\xef\x83\x90";          // magic
inline constexpr const char* kPlace = "\xef\x84\xa4";          // location-arrow
inline constexpr const char* kRecolor = "\xef\x81\x83";        // tint
inline constexpr const char* kSequence = "\xef\x83\x8b";       // list-ol
inline constexpr const char* kDisplace = "\xef\x83\xac";       // exchange
inline constexpr const char* kSliders = "\xef\x87\x9e";        // sliders
inline constexpr const char* kActor = "\xef\x86\xae";          // child
inline constexpr const char* kFormulaFile = "\xef\x87\x89";    // file-code-o
inline constexpr const char* kFields = "\xef\x83\x8e";         // table
inline constexpr const char* kPictures = "\xef\x80\xbe";       // picture-o
inline constexpr const char* kFilm = "\xef\x80\x88";           // film
inline constexpr const char* kTime = "\xef\x80\x97";           // clock-o
inline constexpr const char* kReload = "\xef\x80\xa1";         // refresh
inline constexpr const char* kDown = "\xef\x81\xa3";           // arrow-down
inline constexpr const char* kText = "\xef\x80\xb1";           // font
inline constexpr const char* kToStart = "\xef\x81\x89";        // fast-backward
inline constexpr const char* kStepBack = "\xef\x81\x88";       // step-backward
inline constexpr const char* kPlay = "\xef\x81\x8b";           // play
inline constexpr const char* kPause = "\xef\x81\x8c";          // pause
inline constexpr const char* kStepForward = "\xef\x81\x91";    // step-forward
inline constexpr const char* kToEnd = "\xef\x81\x90";          // fast-forward
inline constexpr const char* kLoop = "\xef\x81\xb9";           // retweet
inline constexpr const char* kRecord = "\xef\x84\x91";         // circle
inline constexpr const char* kKey = "\xef\x82\x84";            // key
inline constexpr const char* kDrop = "\xef\x83\x97";           // caret-down

}  // namespace voledit::icons
