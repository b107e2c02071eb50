# Draws error-poisson-hanging-bar.svg and error-poisson-hanging-bar.png: gnuplot error-poisson-hanging-bar.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'error-poisson-hanging-bar.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Poisson''s ratio: error on hanging-bar'
set xlabel 'Poisson''s ratio'
set ylabel 'relative error (rms)'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale y
set format y '%g'
plot \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'galerkin-bem' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 1 title 'galerkin-bem', \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'quadratic-fem' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#e69f00' lw 2 pt 11 ps 0.8 dt 1 title 'quadratic-fem', \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'linear-bem' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem', \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'linear-bem restricted' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#56b4e9' lw 2 pt 6 ps 0.8 dt 2 title 'linear-bem restricted', \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'linear-bem continuous' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#666666' lw 2 pt 4 ps 0.8 dt 2 title 'linear-bem continuous', \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'fem' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem', \
  'error.csv' using ((strcol('part') eq 'poisson' && strcol('problem') eq 'hanging-bar' && strcol('variant') eq 'constant-bem' ? column('nu') : NaN)):(column('error')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem'
unset output
reset
}
