# Draws scale-set_change.svg and scale-set_change.png: gnuplot scale-set_change.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'scale-set_change.'.kind
set datafile separator ','
set datafile missing NaN
set title 'First constrained set'
set xlabel 'vertices'
set ylabel 'set change [s]'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'scale.csv' using ((strcol('method') eq 'galerkin-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 1 title 'galerkin-bem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'galerkin-bem' && strcol('mode') eq 'full' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 2 title 'galerkin-bem, full', \
  'scale.csv' using ((strcol('method') eq 'quadratic-fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#e69f00' lw 2 pt 11 ps 0.8 dt 1 title 'quadratic-fem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'nonlinear-fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#56b4e9' lw 2 pt 6 ps 0.8 dt 1 title 'nonlinear-fem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'fem' && strcol('mode') eq 'full' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 2 title 'fem, full', \
  'scale.csv' using ((strcol('method') eq 'fem' && strcol('mode') eq 'full-volume' ? column('vertices') : NaN)):(column('set_change_s')) with points lc rgb '#0072b2' lw 2 pt 7 ps 0.8 title 'fem, full-volume', \
  'scale.csv' using ((strcol('method') eq 'constant-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'constant-bem' && strcol('mode') eq 'full' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 2 title 'constant-bem, full', \
  'scale.csv' using ((strcol('method') eq 'linear-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'linear-bem' && strcol('mode') eq 'full' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 2 title 'linear-bem, full'
unset output
reset
}
