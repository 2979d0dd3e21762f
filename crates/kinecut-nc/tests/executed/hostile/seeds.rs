//! Programs that the hostile ones are made of, of each family of controls.

use kinecut_nc::nc::Control::{self, Fanuc, Grbl, GrblHal, Haas, LinuxCnc};

const LINUXCNC: &[&str] = &[
    "G21 G17 G90 G64 P0.05\nT1 M6\nG43 H1\nS3000 M3\n#1=3 #<depth>=-2\no<hole> sub\n G0 X#1 Y#2\n o10 if [#<_z> GT 0 AND #1 LT 9]\n  G1 Z[#3-1] F100\n \
     o10 elseif [#1 EQ 9]\n  G4 P0.5\n o10 else\n  G0 Z5\n o10 endif\no<hole> endsub [#1*2]\nG0 X0 Y0 Z5\no1 repeat [3]\n o<hole> call [#1] [2] [#<depth>]\n \
     #1=[#1+1]\no1 endrepeat\no2 while [#1 GT 2]\n G1 X[SIN[#1*30]*10] Y[ATAN[#1]/[2]] F300\n #1=[#1-1]\n o3 if [#1 LT 3]\n  o2 break\n o3 endif\no2 endwhile\n\
     M98 P100 L2\no<part> call\nM2\nO100\nG91 G1 X1 F50\nG90\nM99\n",
    "G20 G90 G54 G61\nG10 L2 P1 X1 Y2 Z3 R10\nG10 L20 P2 X0\nG10 L1 P2 R0.1 Z2\nT2 M6 G43.1 Z1\nG92 X1 Y1\nG0 X1 Y1 Z1\nG52 X.1\nG41.1 D.2\nG1 X2 F9\nG3 X3 Y2 I.5 J.5\n\
     G40\nG5 X1 Y3 I1 J0 P-1 Q1\nG5 X2 Y1 P-1 Q0\nG5.2 X1 Y1 P1 L3\nX2 Y2 P1\nX3 Y1 P2\nG5.3\nG18 G2 X1 Z0 R3 P2\nG17 G98 G83 X1 Y1 R.5 Z-1 Q.3 L3\nG91 X.1 L4\nG80 G90\n\
     G38.2 Z-1 F2\nG53 G0 Z0\nG28 Z1\nG30.1\nM70\nG55\nM72\nM66 P0 L0\nG93 G1 X1 F2\nG95 X2 F.1\n(MSG, here)\nM60\nG59.3 G0 X1\nG92.1\nM30\n",
];
const GRBL: &[&str] = &[
    "G21 G90 G94\nM3 S1000\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG2 X10 Y0 I5 J0\nG3 X0 R5\nG91 G1 X1\nG90\nG53 G0 Z0\nG92 X0\nG10 L20 P1 X0 Y0 Z0\nG38.2 Z-5 F10\nG28 G91 Z0\n\
     G4 P.2\n$H\nM8\nM9\nM0\nM5\nM30\n",
];
const GRBLHAL: &[&str] = &[
    "G21 G90\nT1 M6\nG43 H1\nG49\nM3 S900\nG0 X0 Y0 Z5\nG99 G81 X1 Y1 Z-2 R1 F60\nX2\nG98 G83 X3 Q.5\nG80\n#1=2\nG1 X[#1*2] F90\nG92 X1\nG92.1\nM30\n",
];
const FANUC: &[&str] = &[
    "%\nO1000(PART)\nG21 G17 G90 G94 G54 G40 G49 G80\nT1 M6\nG43 H1 Z50.\nS3000 M3\n#1=3\n#100=[#1*2+SIN[30.]]\nWHILE[#1GT0]DO1\nIF[#1EQ2]GOTO20\nG1 X#1 Y[#100-1] F200.\n\
     N20 #1=#1-1\nEND1\nG65 P9000 A1. B2.5 C#1 L2\nM98 P29000\nG68 X0 Y0 R30.\nG1 G41 D1 X10. Y0.\nX20. ,R2.\nY10. ,C1.\nX0.\nG40 Y-5.\nG69\nG83 X1. Y1. Z-5. R2. Q1. F80. K2\n\
     X2.\nG80 X5.\nG16 X10. Y45.\nG15\nG10 L2 P1 X1. Y2.\nG52 X1.\nG51 X0 Y0 P2000\nG1 X1.\nG50\nG51.1 X0\nG2 X2. Y2. R5.\nG50.1 X0\nG66 P9000 A1.\nX3.\nG67\nG54.1 P3\n\
     G91 G28 Z0.\nM30\nO9000\nIF[#1GT5.]THEN#2=1.\n#3=#1+#2\nG91 G1 Z-#1 F[#2*100.]\nG90\nM99\n%\n",
    "O2\nG20\nG90 G0 X1 Y2\nG76 X1. Y1. Z-1. R.1 Q.01 P500 F5.\nG87 X2. R-1. Z.5 Q.01\nG88 X3. R.1 Z-1.\nG80\nG7.1\nG5.1 Q1\nG8 P1\nG93 G1 X1. F3.\nG95 X2. F.01\nG84 X1. Z-1. R.1\n\
     M29 S500\nG74 X2. F.05\n#500=#3001\n#3000=1(STOP)\nG31 Z-1. F5.\nG53 Z0\nG30 P2 Z0\nG92 X0\nM99 P10\nN10 M30\n",
];
const HAAS: &[&str] = &[
    "%\nO1\nG20 G90 G54\nT1 M6\nG43 H1 Z1.\nS900 M3\nG0 X0. Y0.\nG98 G81 X1. Z-.5 R.1 F5. L0\nG70 I1. J30. L6\nG71 I1. J0. K10. L4\nG72 I.5 J45. L5\nG80\nM97 P100 L2\nG154 P3 X0.\n\
     G110\nG73 X1. Z-1. R.1 I.3 J.1 K.05\nG83 X2. Q.2\nG51 P2.\nG1 X1.\nG50\nG4 P1.\nG187 P3 E.01\nG103 P1\n#1=#5041\nG28\nM30\nN100 G91 G1 X.1 F9.\nG90\nM99\n%\n",
];

/// Programs of each control, and words that are put into them.
pub(crate) const FAMILIES: [(Control, &[&str]); 5] =
    [(LinuxCnc, LINUXCNC), (Grbl, GRBL), (GrblHal, GRBLHAL), (Fanuc, FANUC), (Haas, HAAS)];

/// Pieces of programs.
pub(crate) const WORDS: [&str; 64] = [
    "#",
    "[",
    "]",
    "##1",
    "#[#1]",
    "#<a>",
    "=",
    "**",
    " MOD ",
    " EQ ",
    "/0",
    "-",
    "+",
    ".",
    "1e9",
    "999999999",
    "-0",
    "0",
    "G0",
    "G1",
    "G2",
    "G3",
    "G28",
    "G53",
    "G68 R45",
    "G91",
    "G20",
    "G80",
    "G41 D1",
    "G40",
    "M6",
    "M98 P100",
    "M98 P1",
    "M99",
    "M30",
    "M2",
    "(",
    ")",
    ";",
    "%",
    "\n",
    "\r\n",
    "o1 while [1]\n",
    "o1 endwhile\n",
    "o2 if [#1]\n",
    "o2 endif\n",
    "o3 repeat [9]\n",
    "o3 endrepeat\n",
    "o<hole> call [1]\n",
    "WHILE[1]DO1\n",
    "END1\n",
    "GOTO20\n",
    "IF[#1LT3]GOTO20\n",
    "G65 P9000",
    "G66 P9000",
    ",R1.",
    ",C",
    "L1000",
    "P0",
    "Q0",
    "R",
    "\u{b0}",
    "N20",
    "\t",
];
