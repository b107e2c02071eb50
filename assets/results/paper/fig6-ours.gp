# Draws fig6-ours.svg and fig6-ours.png: gnuplot fig6-ours.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'fig6-ours.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Update with 30 % known: Eqn. 9 and what replaces it'
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
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'fem' && strcol('part') eq 'update' && strcol('update') eq 'eqn9' && strcol('share') eq '0.3' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem, Eqn. 9', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'fem' && strcol('part') eq 'update' && strcol('update') eq 'reduced' && strcol('share') eq '0.3' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 2 title 'fem, collapsed', \
  'paper.csv' using ((strcol('way') eq 'ours' && strcol('method') eq 'fem' && strcol('part') eq 'update' && strcol('update') eq 'on-demand' && strcol('share') eq '0.3' && strcol('choice') eq 'random' ? column('vertices') : NaN)):(column('set_change_s')) with points lc rgb '#0072b2' lw 2 pt 7 ps 0.8 title 'fem, on demand', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'constant-bem' && strcol('part') eq 'update' && strcol('update') eq 'eqn9' && strcol('share') eq '0.3' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem, Eqn. 9', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'constant-bem' && strcol('part') eq 'update' && strcol('update') eq 'reduced' && strcol('share') eq '0.3' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 2 title 'constant-bem, collapsed', \
  'paper.csv' using ((strcol('way') eq 'ours' && strcol('method') eq 'constant-bem' && strcol('part') eq 'update' && strcol('update') eq 'on-demand' && strcol('share') eq '0.3' && strcol('choice') eq 'random' ? column('vertices') : NaN)):(column('set_change_s')) with points lc rgb '#d55e00' lw 2 pt 5 ps 0.8 title 'constant-bem, on demand', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'linear-bem' && strcol('part') eq 'update' && strcol('update') eq 'eqn9' && strcol('share') eq '0.3' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem, Eqn. 9', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'linear-bem' && strcol('part') eq 'update' && strcol('update') eq 'reduced' && strcol('share') eq '0.3' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 2 title 'linear-bem, collapsed', \
  'paper.csv' using ((strcol('way') eq 'ours' && strcol('method') eq 'linear-bem' && strcol('part') eq 'update' && strcol('update') eq 'on-demand' && strcol('share') eq '0.3' && strcol('choice') eq 'random' ? column('vertices') : NaN)):(column('set_change_s')) with points lc rgb '#009e73' lw 2 pt 9 ps 0.8 title 'linear-bem, on demand'
unset output
reset
}
