# Draws error-pressed-sphere-nu0.3.svg and error-pressed-sphere-nu0.3.png: gnuplot error-pressed-sphere-nu0.3.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'error-pressed-sphere-nu0.3.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Error against time: pressed-sphere, nu 0.3'
set xlabel 'from the mesh until ready to drag [s]'
set ylabel 'relative error (rms)'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'galerkin-bem' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 1 title 'galerkin-bem', \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'quadratic-fem' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#e69f00' lw 2 pt 11 ps 0.8 dt 1 title 'quadratic-fem', \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'linear-bem' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem', \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'linear-bem restricted' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#56b4e9' lw 2 pt 6 ps 0.8 dt 2 title 'linear-bem restricted', \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'linear-bem continuous' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#666666' lw 2 pt 4 ps 0.8 dt 2 title 'linear-bem continuous', \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'fem' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem', \
  'error.csv' using ((strcol('part') eq 'refinement' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('variant') eq 'constant-bem' ? column('ready_s') : NaN)):(column('error')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem'
unset output
reset
}
